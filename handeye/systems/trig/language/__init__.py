"""TRIG: programs taught by doing, drawn as they grow, and run forwards or backwards at any moment [MIT, 1982]."""
