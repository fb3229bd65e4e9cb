"""Runs that can be stepped, saved, resumed, and returned to an earlier state."""
