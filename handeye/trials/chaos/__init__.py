"""Chaos trials: faults, interruptions and operator's answers are drawn from a seed, and invariants are checked
after each run."""
