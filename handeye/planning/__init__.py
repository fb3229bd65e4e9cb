"""The planning phase: makes a plan from a program and an arm. It uses no clock, random numbers or simulator."""
