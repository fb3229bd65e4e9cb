"""Runs that can be stepped, stopped, kept, taken up again and put back in time."""
