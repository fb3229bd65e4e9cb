"""Proves, for the checks of a program, whether every path through the program passes them. The prover reads only the
program: it uses no simulator, no clock and no random numbers.
"""
