"""Programs of TRIG as runs: taught in the world of a run, carried out step by step, and undone by the arm."""
