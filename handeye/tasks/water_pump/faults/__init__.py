"""Faults of the pump's cell: before a run, during it, and between the work and its undoing."""
