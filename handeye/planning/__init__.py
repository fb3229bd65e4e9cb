"""The planning phase: makes a plan from a program and an arm. Planning uses no clock, random numbers or simulator."""
