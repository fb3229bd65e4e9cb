"""What two pictures of a part tell of it; apart from how it is found, for which OpenCV is needed."""

from dataclasses import dataclass

from handeye.program.causes import PartAstray


@dataclass(frozen=True, slots=True, kw_only=True)
class PartMatch:
    """Findings on a part in two pictures."""

    cause: PartAstray | None
    """Why it does not stand as it stood; None: it does."""
    outline: tuple[tuple[float, float], ...]
    """Where it should be in the second picture, corners (u, v)."""
    shift: float
    """By how much it has moved against what is around it, m at the height of its face."""
    unlike: float
    """Share of its points that have changed, once that is undone."""

    @property
    def ok(self) -> bool:
        """It stands as it stood."""
        return self.cause is None
