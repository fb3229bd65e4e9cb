"""Estimates the probability of rare failures, and searches for the nearest worlds in which a program fails."""
