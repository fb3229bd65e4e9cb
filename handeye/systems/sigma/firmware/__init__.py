"""Firmware of the microcomputers. It takes commands and pin levels, and produces pulses and answers."""
