"""The referee: what it measures on the truth, and what it finds. What is right, and why, each task says."""
