"""Proves which checks every path through a program passes. The prover reads only the program: it uses no simulator, no
clock and no random numbers.
"""
