"""Functions executed one at a time, and positions taught by moving the arm."""
