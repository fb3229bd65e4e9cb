"""Finds out, for each check of a program, whether every path through the program passes the check. The prover reads
only the program: it uses no simulator, no clock and no random numbers.
"""
