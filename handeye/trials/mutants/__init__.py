"""Mutants of a program: what happens if one check of the program is missing or weaker."""
