"""Reversal: the arm takes back its steps one by one along their recorded set-points, under guards."""
