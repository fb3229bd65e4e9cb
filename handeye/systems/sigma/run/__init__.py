"""MAL programs as runs, which can be stepped by statement, saved, resumed, and taken back to earlier states of
all tasks."""
