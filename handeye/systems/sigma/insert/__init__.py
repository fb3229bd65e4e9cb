"""The insertion: each arm straightens pegs in a rack, and finds the holes for them by force."""
