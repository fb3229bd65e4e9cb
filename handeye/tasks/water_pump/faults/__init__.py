"""Faults of the pump's cell. A fault is present before a run, begins during a run, or is made between the end of the
work and the start of its reversal.
"""
