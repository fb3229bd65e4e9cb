"""The stepper: people step runs with commands, breakpoints and views."""
