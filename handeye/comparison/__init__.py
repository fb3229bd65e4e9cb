"""Compares two runs step by step: their first difference, searches, guarded motions and corrections."""
