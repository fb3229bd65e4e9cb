"""Faults of the pump's cell. They are present before a run, begin during a run, or are made between the work and
its reversal.
"""
