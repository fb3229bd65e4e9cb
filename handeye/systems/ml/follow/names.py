"""The names of the outlines, apart from their shapes, which need a simulator."""

from typing import Literal

OutlineName = Literal["square", "L", "U", "disc"]
