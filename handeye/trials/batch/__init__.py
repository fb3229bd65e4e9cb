"""Batches: many whole runs of one plan, kept in a folder, and the figures that they make."""
