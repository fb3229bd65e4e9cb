"""The working phase: executes a plan in a cell, through the device interfaces of the cell."""
