"""The stepper. Users step through a run with it, set breakpoints, and view the state of the run."""
