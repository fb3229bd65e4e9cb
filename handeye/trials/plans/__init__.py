"""Trials of planned programs in many worlds: assembly, or assembly followed by dismantling."""
