"""Faults of the pump's cell that are present before a run, that begin during a run, or that are made between
the work and its reversal."""
