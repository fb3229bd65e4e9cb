"""What is asked of a video."""

import math
from dataclasses import dataclass
from typing import Final

from handeye.cell.photograph import LARGEST, SMALLEST
from handeye.core.errors import BadArgument
from handeye.core.whole_numbers import whole

SECONDS: Final = 14.0
"""How long a video is where nobody says."""
LONGEST: Final = 600.0
"""s of a video."""
ORBIT: Final = "orbit"
"""The view that sways slowly round all of the cell."""
FOLLOW: Final = "follow"
"""The view that goes near to where the hand works, stage by stage."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Wanted:
    """What is asked of a video; raises InvalidInput if there can be no such video."""

    camera: str = ORBIT
    """A camera of the scene, `orbit` or `follow`."""
    width: int = 480
    height: int = 360
    seconds: float | None = None
    """How long it is; by default `SECONDS`."""
    speed: float | None = None
    """How many times as fast as the run it is, instead."""
    first: str | int | None = None
    """The stage that it begins with: number, name, or a piece of the name; by default the first."""
    last: str | int | None = None
    """The stage that it ends with."""
    captions: bool = False
    """It says which stage is under way, and shows the pictures that the program takes."""

    def __post_init__(self) -> None:
        sides = [whole(side) for side in (self.width, self.height)]
        if not all(side is not None and SMALLEST <= side <= LARGEST for side in sides):
            raise BadArgument(
                f"a video of {self.width} x {self.height} cannot be made; a side has {SMALLEST} to {LARGEST} points"
            )
        if self.seconds is not None and self.speed is not None:
            raise BadArgument("a video has a length or a speed; the other follows")
        if self.seconds is not None and not (_is_number(self.seconds) and 0 < self.seconds <= LONGEST):
            raise BadArgument(f"a video takes up to {LONGEST:g} s, and not {self.seconds} s")
        if self.speed is not None and not (_is_number(self.speed) and self.speed > 0):
            raise BadArgument(f"a video is some times as fast as the run, and not {self.speed} times")
        for stage in (self.first, self.last):
            if isinstance(stage, bool) or not isinstance(stage, str | int | None):
                raise BadArgument(f"a stage is given by its number or its name, not {stage!r}")
        if not isinstance(self.camera, str):
            raise BadArgument(f"a camera is given by its name, not {self.camera!r}")


def _is_number(given: object) -> bool:
    return isinstance(given, (int, float)) and math.isfinite(given)
