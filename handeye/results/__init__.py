"""Presents results of runs as text and as JSON."""
