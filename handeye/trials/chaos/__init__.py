"""Chaos trials: schedules of faults, interruptions and answers, drawn from a seed, and checked against invariants."""
