"""Chaos trials: faults, interruptions and answers of the operator are drawn at random from a seed, and invariants
are checked after each run.
"""
