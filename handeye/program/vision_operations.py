"""Operations of the camera and of vision."""

from typing import ClassVar

from handeye.core import errors
from handeye.ports.camera import LENSES
from handeye.program.operation import Operation, action


class Lens(Operation, frozen=True, kw_only=True):
    """Turn the lens turret to the lens with a given focal length (m)."""

    family: ClassVar = "sight"
    needs: ClassVar = "camera"
    takes_time: ClassVar = True
    raising: ClassVar = action()
    choices: ClassVar = {"focal_length": LENSES}

    focal_length: float


class Aim(Operation, frozen=True, kw_only=True):
    """Turn the camera to a position or a part, and focus it on this position or part."""

    family: ClassVar = "sight"
    needs: ClassVar = "camera"
    takes_time: ClassVar = True
    raising: ClassVar = action()
    reading: ClassVar = {"target": ("target",)}

    target: str


class Look(Operation, frozen=True, kw_only=True):
    """Take a picture and keep it under a name."""

    family: ClassVar = "sight"
    needs: ClassVar = "camera"
    takes_time: ClassVar = True
    raising: ClassVar = action(errors.PICTURE_WRONG)
    writing: ClassVar = {"picture": ("picture",)}

    picture: str
    hold_target: bool = False  # keep the target voltage of the previous picture, for differencing


class General(Operation, frozen=True, kw_only=True):
    """Locate a part roughly by its outline in a picture. Raises error 30 if the part is not seen."""

    family: ClassVar = "sight"
    raising: ClassVar = action(errors.PART_NOT_SEEN)
    reading: ClassVar = {"picture": ("picture",)}
    writing: ClassVar = {"part": ("part",)}

    part: str
    picture: str

    @property
    def examines(self) -> str | None:
        return self.picture


class Specific(Operation, frozen=True, kw_only=True):
    """Measure the pose of a part by its holes in a picture. Raises error 31 if the holes are not found."""

    family: ClassVar = "sight"
    raising: ClassVar = action(errors.FEATURES_NOT_SEEN)
    reading: ClassVar = {"part": ("part",), "picture": ("picture",)}
    writing: ClassVar = {"part": ("part",)}

    part: str
    picture: str

    @property
    def examines(self) -> str | None:
        return self.picture


class Comparison(Operation, frozen=True, kw_only=True):
    """Base class of comparisons of two pictures of a part."""

    family: ClassVar = "sight"
    reading: ClassVar = {"part": ("part",), "picture": ("before", "after")}

    part: str
    before: str
    after: str

    @property
    def examines(self) -> str | None:
        return self.after


class Inspect(Comparison, frozen=True, kw_only=True):
    """Compare a picture taken before a gasket was laid on the part with a picture taken afterwards. Raises error 32 if
    the gasket is not in place.
    """

    raising: ClassVar = action(errors.GASKET_WRONG)


class Match(Comparison, frozen=True, kw_only=True):
    """Compare two pictures of a part. Raises error 33 if the part has moved."""

    raising: ClassVar = action(errors.PART_ASTRAY)


VisionOperation = Lens | Aim | Look | General | Specific | Inspect | Match
