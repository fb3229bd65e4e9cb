"""Builds the report of a run as one HTML page, with one module per section."""
