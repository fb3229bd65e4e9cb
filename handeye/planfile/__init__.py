"""The plan, which is the interface between the planning phase and the working phase: its file format and its
checks.
"""
