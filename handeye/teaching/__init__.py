"""Executes single instructions, and stores the positions to which the arm was moved."""
