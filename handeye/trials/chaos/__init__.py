"""Schedules of faults, interruptions and answers, drawn from a seed and checked against what must always hold."""
