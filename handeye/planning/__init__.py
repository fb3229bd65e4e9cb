"""The planning phase: a program and an arm make a plan. No clock, no randomness, no simulator."""
