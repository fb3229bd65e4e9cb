"""Diagnosis of SUPERSIGMA: self-tests, twenty faults, the paper's order of tests, and a game."""
