"""MAL programs as runs: stepped by statements, kept, resumed and taken back in time through all their tasks."""
