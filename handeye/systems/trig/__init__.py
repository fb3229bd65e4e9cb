"""TRIG (MIT, 1982): programs that are taught by doing, and run backwards."""
