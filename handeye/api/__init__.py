"""The Python interface: plans, worlds and runs as values with a readable display."""
