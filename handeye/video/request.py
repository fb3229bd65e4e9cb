"""Options of a video."""

import math
from dataclasses import dataclass
from typing import Final

from handeye.cell.photograph import LARGEST, SMALLEST
from handeye.core.arguments import whole
from handeye.core.errors import BadArgument

SECONDS: Final = 14.0  # default duration
LONGEST: Final = 600.0  # s
ORBIT: Final = "orbit"  # a view that sways slowly around the cell
FOLLOW: Final = "follow"  # a view close to the hand's work, stage by stage


@dataclass(frozen=True, slots=True, kw_only=True)
class VideoRequest:
    """The options of a video. Raises BadArgument if the options are impossible."""

    camera: str = ORBIT  # a camera of the scene, `orbit` or `follow`
    width: int = 480
    height: int = 360
    seconds: float | None = None  # duration; `SECONDS` by default
    speed: float | None = None  # speed-up over the run, instead of a duration
    first: str | int | None = None
    """First stage: number, name, or part of the name; by default the first stage of the run."""
    last: str | int | None = None  # last stage
    captions: bool = False  # show the stage, and the program's pictures

    def __post_init__(self) -> None:
        sides = [whole(side) for side in (self.width, self.height)]
        if not all(side is not None and SMALLEST <= side <= LARGEST for side in sides):
            raise BadArgument(
                f"a video of {self.width} x {self.height} cannot be made; each side must have {SMALLEST} to "
                f"{LARGEST} pixels"
            )
        if self.seconds is not None and self.speed is not None:
            raise BadArgument(
                "give either the length or the speed of a video, not both: each determines the other"
            )
        if self.seconds is not None and not (_is_number(self.seconds) and 0 < self.seconds <= LONGEST):
            raise BadArgument(
                f"the length of a video must be more than 0 and at most {LONGEST:g} s, not {self.seconds} s"
            )
        if self.speed is not None and not (_is_number(self.speed) and self.speed > 0):
            raise BadArgument(
                f"the speed of a video, as a multiple of the speed of the run, must be above 0, not {self.speed}"
            )
        for stage in (self.first, self.last):
            if isinstance(stage, bool) or not isinstance(stage, str | int | None):
                raise BadArgument(f"give a stage by its number or its name, not by {stage!r}")
        if not isinstance(self.camera, str):
            raise BadArgument(f"give the name of a camera, not {self.camera!r}")


def _is_number(given: object) -> bool:
    return isinstance(given, (int, float)) and math.isfinite(given)
