"""Firmware of the microcomputers: bytes and pins in, pulses and bytes out."""
