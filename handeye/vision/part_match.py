"""The result of comparing two pictures of a part; apart from `matching`, which needs OpenCV."""

from dataclasses import dataclass

from handeye.program.diagnosis.causes import PartAstray


@dataclass(frozen=True, slots=True, kw_only=True)
class PartMatch:
    """Result for a part in two pictures."""

    cause: PartAstray | None  # None: it stands as it stood
    outline: tuple[tuple[float, float], ...]  # expected in the second picture, corners (u, v)
    shift: float  # m against its surroundings, at the height of its face
    unlike: float  # fraction of its points that have changed, after aligning

    @property
    def ok(self) -> bool:
        """True if it stands as it stood."""
        return self.cause is None
