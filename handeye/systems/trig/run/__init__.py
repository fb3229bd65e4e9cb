"""TRIG programs as runs: a program is taught in the world of the run and executed step by step. Then the arm undoes
its work: it executes the program backwards.
"""
