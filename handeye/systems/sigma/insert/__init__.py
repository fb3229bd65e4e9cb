"""The insertion: each arm straightens pegs in a rack, and measures forces to find the holes for the pegs."""
