"""The working phase: executes a plan in a cell through the cell's device interfaces."""
