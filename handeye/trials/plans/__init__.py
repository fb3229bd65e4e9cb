"""Trials of planned programs: assembled, or assembled and taken apart again, in many worlds."""
