"""Mutants of a program: what happens if one of its checks is missing or weaker."""
