"""TRIG programs as runs: a program is taught in the world of the run, executed step by step, and reversed by
the arm."""
