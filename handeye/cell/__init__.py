"""The simulated cell: MuJoCo behind the device interfaces. The cell contains no task; each task composes its cell
from these parts.
"""
