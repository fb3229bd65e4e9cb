"""Collects the facts of a run for display: pictures, forces, planned and measured positions, and outcome."""
