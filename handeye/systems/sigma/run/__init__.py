"""MAL programs as runs: stepped by statement, saved, resumed, and taken back to earlier states of all tasks."""
