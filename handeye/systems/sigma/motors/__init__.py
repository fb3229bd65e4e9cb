"""Stepping motors: pulse trains, and the rotor that follows them or slips."""
