"""The insertion: each arm squares pegs in a rack, and finds the holes for them by force."""
