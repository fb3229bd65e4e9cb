"""Mutants of a program. Each mutant shows what happens if one check of the program is missing or weaker."""
