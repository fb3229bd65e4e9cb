"""TRIG programs as runs: taught in the world of the run, executed step by step, and reversed by the arm."""
