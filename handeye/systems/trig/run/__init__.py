"""TRIG programs as runs: taught in the run's world, executed step by step, and reversed by the arm."""
