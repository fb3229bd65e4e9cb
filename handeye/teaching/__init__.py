"""Executes single instructions, and stores positions to which the arm has been moved."""
