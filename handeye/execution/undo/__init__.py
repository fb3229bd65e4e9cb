"""Reversal: the arm undoes its steps one by one. It goes back along the recorded set-points, with guards."""
