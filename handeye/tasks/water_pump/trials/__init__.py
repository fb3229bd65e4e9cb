"""Trials of vision in many worlds of the pump, without running a program."""
