"""Firmware of the microcomputers: takes commands and pin levels, and gives pulses and answers."""
