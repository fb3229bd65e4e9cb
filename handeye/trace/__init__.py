"""Writes, reads and analyses traces. A trace is the recording of one run: an MCAP file, which other robotics tools
can open.
"""
