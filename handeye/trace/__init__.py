"""Traces: one MCAP file a run, which other robotics tools open, and what can be learnt from it afterwards."""
