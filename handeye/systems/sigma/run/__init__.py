"""Runs of MAL programs. A run can be stepped one statement at a time, saved and resumed, and taken back to an earlier
state of all tasks.
"""
