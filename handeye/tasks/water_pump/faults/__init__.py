"""Faults of the pump's cell: before a run, during a run, and between the work and its reversal."""
