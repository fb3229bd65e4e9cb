"""Checks of a program that has no syntax errors."""
