"""The names of the outlines. They are apart from the shapes, which need a simulator."""

from typing import Literal

OutlineName = Literal["square", "L", "U", "disc"]
