"""Trials of planned programs in many worlds: assembly alone, or assembly followed by dismantling."""
