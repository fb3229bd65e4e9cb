"""The simulated cell: MuJoCo behind the device interfaces. It contains no task; each task composes a cell from
these parts.
"""
