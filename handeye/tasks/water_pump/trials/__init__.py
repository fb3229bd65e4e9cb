"""Trials of the eye in many worlds of the pump, without carrying out a program."""
