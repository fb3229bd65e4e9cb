"""Traces: one MCAP file per run, which other robotics tools can open, and the analysis of traces."""
