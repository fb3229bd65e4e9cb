"""Reversal: the arm undoes its steps one by one. The arm goes back along the recorded set-points, with guards."""
