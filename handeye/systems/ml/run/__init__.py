"""Runs of ML programs."""
