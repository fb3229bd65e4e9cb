"""The file format of plans, and the checks of a plan. The plan is the interface between the planning phase and the
working phase.
"""
