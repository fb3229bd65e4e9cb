"""Functions carried out one at a time, and positions taught by moving the arm."""
