"""Compares two runs step by step: first differences, searches, guarded motions and corrections."""
