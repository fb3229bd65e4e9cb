"""The names of the outlines. The names have a module of their own, because the module of the shapes needs a
simulator.
"""

from typing import Literal

OutlineName = Literal["square", "L", "U", "disc"]
