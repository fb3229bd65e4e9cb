"""Compares handeye's vision with OpenCV on the same pictures: the outline of a part in distant pictures, and its two
large holes in close ones.
"""

import math
from collections.abc import Iterable, Iterator
from functools import partial
from typing import Final

import cv2
import numpy as np

from benchmarks.opencv_eye import holes_by_blob_detector, holes_by_components, largest_component
from benchmarks.peers import Comparison, Outcome, Trial, Way
from benchmarks.sights import Sight
from handeye.core.pose import Array
from handeye.vision.base import (
    Failure,
    GeneralLocation,
    SpecificLocation,
    close_box,
    fitting,
    locate_general,
    locate_specific,
    silhouettes,
    window,
)
from handeye.vision.blob import BoundingBox
from handeye.vision.hole_search import hole_places

OPENCV: Final = f"OpenCV {cv2.__version__}"
_way = partial(Way.measured, unit="points")


def measure(sights: Iterable[Sight], times: int) -> Iterator[Comparison]:
    """Find the outline of the part and then its holes in each sight, `times` times with each method.

    All methods search for the holes in the box that handeye's own method has found in the distant picture.
    """
    seen = list(sights)
    yield _outlines(seen, times)
    found = [(sight, locate_general(*sight.far, sight.part)) for sight in seen]
    yield _holes([(sight, at) for sight, at in found if isinstance(at, GeneralLocation)], times)


def _outlines(seen: list[Sight], times: int) -> Comparison:
    ours, theirs = [], []
    for sight in seen:
        (picture, view), part = sight.far, sight.part
        ours.append((partial(locate_general, picture, view, part), partial(_outline, sight)))
        theirs.append((partial(largest_component, picture, window(view, part)), partial(_box, sight)))
    return Comparison(
        ours=_way("outline", "beams and a growing box", trials=ours, times=times),
        others=(_way("outline", f"Otsu and components, {OPENCV}", trials=theirs, times=times),),
    )


def _outline(sight: Sight, found: GeneralLocation | Failure) -> Outcome:
    if isinstance(found, Failure):
        return Outcome(error=None)
    return Outcome(error=_off(sight, found.box), read=found.points / sight.far[0].size)


def _box(sight: Sight, box: BoundingBox | None) -> Outcome:
    fits = fitting(sight.far[1], sight.part)
    return Outcome(error=_off(sight, box) if box and fits(box) else None)


def _off(sight: Sight, box: BoundingBox) -> float:
    """Return the distance between the middle of a box and the middle of the part's true outline (points)."""
    x, y, yaw = sight.pose
    (true,) = silhouettes(sight.far[1], sight.part, (x, y), np.array([yaw - sight.part.at[3]]))
    return math.dist(box.corners().mean(axis=0), (true.min(axis=0) + true.max(axis=0)) / 2)


def _holes(seen: list[tuple[Sight, GeneralLocation]], times: int) -> Comparison:
    ours: list[Trial[SpecificLocation | Failure]] = []
    components: list[Trial[Array | None]] = []
    detector: list[Trial[Array | None]] = []
    for sight, general in seen:
        (picture, view), part = sight.near, sight.part
        ours.append((partial(locate_specific, picture, view, part, general), partial(_located, sight)))
        box = close_box(view, general)
        if box is None:
            continue
        components.append((partial(holes_by_components, picture, view, part, box), partial(_centred, sight)))
        detector.append((partial(holes_by_blob_detector, picture, view, part, box), partial(_centred, sight)))
    others = {"Otsu and components": components, "SimpleBlobDetector": detector}
    return Comparison(
        ours=_way("two holes", "beams and bouncing", trials=ours, times=times),
        others=tuple(
            _way("two holes", f"{name}, {OPENCV}", trials=trials, times=times)
            for name, trials in others.items()
        ),
    )


def _located(sight: Sight, found: SpecificLocation | Failure) -> Outcome:
    if isinstance(found, Failure):
        return Outcome(error=None)
    centres = np.array([[hole.u, hole.v] for hole in found.holes])
    return Outcome(error=_worse(sight, centres), read=found.points / sight.near[0].size)


def _centred(sight: Sight, centres: Array | None) -> Outcome:
    return Outcome(error=None if centres is None else _worse(sight, centres))


def _worse(sight: Sight, centres: Array) -> float:
    """Return the greater of the distances of the two centres from the true centres in the picture (points)."""
    true = sight.near[1].project(hole_places(sight.part, sight.pose)[:2])
    return float(np.hypot(*(centres - true).T).max())
