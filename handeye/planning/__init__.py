"""The planning phase: makes a plan from a program and an arm, without clock, random numbers or simulator."""
