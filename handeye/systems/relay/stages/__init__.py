"""Trials of one stage in several languages, from the same state of the same world."""
