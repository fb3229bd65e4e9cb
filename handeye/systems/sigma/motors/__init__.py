"""Stepping motors: their pulse trains, and the rotor that follows the pulses or slips."""
