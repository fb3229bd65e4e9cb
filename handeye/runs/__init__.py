"""Runs that can be stepped, kept, taken up again and put back in time."""
