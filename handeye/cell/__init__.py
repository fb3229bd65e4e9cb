"""The simulated cell: MuJoCo behind the device interfaces. This package contains no task; each task composes its cell
from the parts in this package.
"""
