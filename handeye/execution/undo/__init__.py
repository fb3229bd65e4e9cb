"""Undo: the arm takes back what it did, step by step, by the set-points that each step has left, under guards."""
