"""Runs that can be stepped, saved, resumed, and taken back to an earlier state."""
