"""Writes, reads and analyses traces. A trace is one MCAP file per run, which other robotics tools can open."""
