"""The names of the outlines. They are not in the module of the shapes, because that module needs a simulator."""

from typing import Literal

OutlineName = Literal["square", "L", "U", "disc"]
