"""Recorded runs as data sets for learned policies."""
