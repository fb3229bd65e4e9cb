"""Faults of the pump's cell. A fault is present before a run, begins during a run, or is made after the work and
before the arm undoes the work.
"""
