"""What Python programs use: plans, worlds and runs as values that show themselves."""
