"""Compares the steps, searches, guarded motions and corrections of two runs, and finds their first difference."""
