"""Runs that can be stepped, kept, resumed and taken back in time."""
