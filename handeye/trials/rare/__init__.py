"""Estimates the probability of rare failures, and searches for the failing worlds whose errors are smallest."""
