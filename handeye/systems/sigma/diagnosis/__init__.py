"""Diagnosis of SUPERSIGMA: self-tests, twenty faults, the order of tests in the paper, and a game."""
