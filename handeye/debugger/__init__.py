"""The stepper, with which users step through runs with commands, breakpoints and views."""
