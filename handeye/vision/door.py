"""The vision primitives for Python programs. Arguments are checked, and a window applies only to one call."""

from collections.abc import Callable
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted
from handeye.core.pose import Array
from handeye.vision import beam, blob, characteriser
from handeye.vision.beam import BRIGHTER, DARKER, Edges, Polarity
from handeye.vision.blob import BoundingBox
from handeye.vision.characteriser import Blob
from handeye.vision.scan import Scan, numbers, places, quadrilateral

_UNIT: Final = 1e-3  # a direction may be this much longer or shorter than 1


def beams(
    scan: Scan,
    starts: ArrayLike,
    directions: ArrayLike,
    polarity: Polarity,
    step: float,
    reach: float | ArrayLike,
    *,
    wide: bool = False,
    beyond: float = 0.0,
) -> Edges:
    """Find the first discontinuity of intensity along each of several rays.

    Positions are in picture points: column u to the right and row v downwards; (0, 0) is the centre of the first
    point. Intensities are in the units of the picture.

    Args:
        starts: start positions (u, v), shape (n, 2), points; each beam starts at the nearest picture point.
        directions: unit vectors (du, dv), shape (n, 2).
        polarity: BRIGHTER finds edges from dark to bright, DARKER from bright to dark.
        step: least difference of mean intensity between the 3 points ahead of the edge and the 3 points behind it.
        reach: greatest length of the beams, points; one number for all beams, or one number for each beam, shape (n,).
        wide: average over three points across the beam, to reduce noise.
        beyond: least intensity beyond the edge; edges to lower intensities are ignored.

    Raises:
        BadArgument: an argument has the wrong type or shape, or is not finite.
    """
    _scan(scan)
    from_where, ways = _points(starts, "starts"), _points(directions, "directions")
    if from_where.shape != ways.shape:
        raise BadArgument(
            f"each beam needs a start and a direction, but there are {counted(len(from_where), 'start')} and "
            f"{counted(len(ways), 'direction')}"
        )
    if len(ways) and np.abs(np.linalg.norm(ways, axis=1) - 1).max() > _UNIT:
        raise BadArgument("the directions of beams must be unit vectors (du, dv)")
    _settings(polarity, step, beyond)
    lengths = numbers(reach, "the reach of a beam must be a number of pixels")
    if lengths.shape not in ((), (len(ways),)) or (lengths < 0).any():
        raise BadArgument(
            f"the reach must be one number of pixels for all beams, or a list of one number for each of "
            f"{counted(len(ways), 'beam')}"
        )
    return beam.beams(
        scan, from_where, ways, polarity, float(step), lengths, wide=bool(wide), beyond=float(beyond)
    )


def localise(
    scan: Scan,
    window: ArrayLike,
    step: float,
    fits: Callable[[BoundingBox], bool] = lambda box: True,
    tries: int = 12,
) -> BoundingBox | None:
    """Find the box around the first blob that lies completely within a window and that `fits` accepts. Returns None if
    there is no such blob.

    Beams go inwards from the four sides of the window until one beam meets a brighter area larger than a speck. A box
    grows from this area until all its sides are in the background. A blob that reaches the border of the window or of
    the picture is ignored. The window applies to this call only.

    Args:
        window: a convex quadrilateral, as its corners (u, v) in order, shape (4, 2), points; its border must lie on
            background.
        step: least difference of intensity between blob and background.
        fits: a function that returns True if a box is the wanted box; a rejected box is not tried again.
        tries: greatest number of boxes to grow.

    Raises:
        BadArgument: an argument has the wrong type or shape, or is not finite.
    """
    _scan(scan)
    corners = quadrilateral(window)
    _settings(BRIGHTER, step, 0.0)
    if not callable(fits):
        raise BadArgument(f"`fits` must be a function that takes a box, not {_kind(fits)}")
    if isinstance(tries, bool) or not isinstance(tries, int | np.integer) or tries < 1:
        raise BadArgument(f"`tries` must be a whole number of 1 or more, not {tries!r:.40}")
    with scan.within(corners):
        return blob.localise(scan, corners, float(step), fits, int(tries))


def characterise(
    scan: Scan,
    seed: ArrayLike,
    step: float,
    reach: float,
    *,
    polarity: Polarity = BRIGHTER,
    wide: bool = False,
    beyond: float = 0.0,
) -> Blob | None:
    """Find the centre, width and height of a convex blob. Beams run from a seed point inside the blob to the edges of
    the blob: first to the left and right, then up and down. The middle between two opposite edges is a better estimate
    of the centre, and the next beams start there. The search ends when the estimate no longer changes. Returns None if
    a beam finds no edge.

    The method is for plain faces, because a beam ends at the first edge. The relief of a coin, or a highlight on a
    sweet, ends a beam too early, so that the blob found is too small. `beyond` and `wide` help against this error. To
    check a result, try a second seed: both seeds should give the same result.

    Args:
        seed: a position (u, v) inside the blob, points.
        step: least difference of intensity across the border.
        reach: greatest distance of the border from the current centre, points.
        polarity: BRIGHTER if the surroundings are brighter than the blob, otherwise DARKER.
        wide: average over three points across each beam.
        beyond: least intensity outside the border, so that the edge of a shadow inside a hole is not taken for the
            border of the hole.

    Raises:
        BadArgument: an argument has the wrong type or shape, or is not finite.
    """
    _scan(scan)
    place = places(seed, "the seed must be a place (u, v)")
    if place.shape != (2,):
        raise BadArgument(f"the seed must be a place (u, v), but the given place has shape {place.shape}")
    _settings(polarity, step, beyond)
    length = _number(reach, "the reach of a beam must be a number of pixels")
    if length <= 0:
        raise BadArgument(f"the reach of a beam must be above 0 pixels, not {length:g}")
    u, v = place.tolist()
    return characteriser.characterise(
        scan, (u, v), float(step), length, polarity=polarity, wide=bool(wide), beyond=float(beyond)
    )


def _scan(given: object) -> None:
    if not isinstance(given, Scan):
        raise BadArgument(f"beams need a Scan of a picture, not {_kind(given)}")


def _kind(given: object) -> str:
    return f"a value of type {type(given).__name__}"


def _settings(polarity: object, step: object, beyond: object) -> None:
    """Raise BadArgument unless the arguments are a polarity and differences of intensity."""
    known = isinstance(polarity, int | np.integer) and not isinstance(polarity, bool)
    if not known or polarity not in (BRIGHTER, DARKER):
        raise BadArgument(
            f"the polarity must be BRIGHTER ({BRIGHTER}) or DARKER ({DARKER}), not {polarity!r:.40}"
        )
    if _number(step, "the step must be a difference of intensity") <= 0:
        raise BadArgument(f"the step of intensity must be above 0, not {step!r:.40}")
    _number(beyond, "the least intensity beyond an edge must be a number")


def _number(given: object, said: str) -> float:
    found = numbers(given, said)
    if found.shape:
        raise BadArgument(f"{said}, but the given array has shape {found.shape}")
    return float(found)


def _points(given: object, name: str) -> Array:
    found = places(given, f"the {name} of the beams must be pairs of numbers, shape (n, 2)")
    if found.ndim != 2 or found.shape[1] != 2:
        raise BadArgument(
            f"the {name} of the beams must be pairs of numbers, shape (n, 2), not {found.shape}"
        )
    return found
