"""Reversal: the arm undoes its steps one by one along their recorded set-points, with guards."""
