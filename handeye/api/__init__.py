"""The Python interface: plans, worlds and runs as values that show themselves."""
