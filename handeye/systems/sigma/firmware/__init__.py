"""Firmware of the microcomputers, which takes commands and pin levels, and produces pulses and answers."""
