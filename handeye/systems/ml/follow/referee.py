"""The referee of the follower: it takes the touches that the computer knows, and compares them with the true outline
of the plate.
"""

from typing import Final

import numpy as np

from handeye.core.pose import Array
from handeye.core.units import MILLIMETRE
from handeye.judge.finding import Findings, at_most
from handeye.systems.ml.machine.spec import LINEAR

RADIUS: Final = 0.8  # mm: radius of the wand
FELT: Final = 3.3
"""Greatest distance (mm) of the wand from the outline when a touch is noticed. This distance is the sum of four terms.
A slide moves by up to 2.1 mm in a cycle. The wand signals when it is bent by .1 mm. A position is wrong by up to .3
mm. When a slide starts suddenly with the speed v, its finger lags behind by up to v sqrt(m / k), which is .8 mm; m and
k are the mass and the stiffness of the finger.
"""
FOUND: Final = 38.1  # mm (1.5 steps): greatest distance from a place on the outline to the nearest touch
UNMOVED: Final = 0.1  # mm
_DEEP: Final = 500.0  # units: a depth that touches do not reach


def judge(touches: Array, outline: Array, before: Array) -> Findings:
    """Return findings on touches, shape (n, 2), in units of the slides.

    Args:
        outline: corners of the plate as it lies now, shape (m, 2), in the same units.
        before: corners of the plate before the program began.
    """
    touches = touches.reshape(-1, 2)
    moved = float(np.hypot(*(outline - before).T).max()) * LINEAR / MILLIMETRE
    off = np.array([distance(touch, outline) for touch in touches]) * LINEAR / MILLIMETRE - RADIUS
    places = along(outline)
    gaps = [float(np.hypot(*(touches - place).T).min(initial=np.inf)) for place in places]
    turning = abs(abs(turning_number(touches, _within(outline))) - 1)
    return {
        "felt": at_most(
            float(np.abs(off).max(initial=0.0)),
            FELT,
            "mm",
            "greatest distance of a touch from the true outline",
        ),
        "found": at_most(
            max(gaps) * LINEAR / MILLIMETRE,
            FOUND,
            "mm",
            "greatest distance from a place on the outline to the nearest touch",
        ),
        "turned": at_most(turning, 0, "", "difference between 1 and the number of turns around the plate"),
        "unmoved": at_most(moved, UNMOVED, "mm", "greatest displacement of the plate"),
    }


def distance(at: Array, outline: Array) -> float:
    """Return the distance of a place from an outline; inside the outline, the distance is negative."""
    ends = np.roll(outline, -1, axis=0)
    way = ends - outline
    share = np.clip(((at - outline) * way).sum(axis=1) / (way**2).sum(axis=1), 0.0, 1.0)
    near = float(np.hypot(*(outline + share[:, np.newaxis] * way - at).T).min())
    return -near if _inside(at, outline) else near


def along(outline: Array, count: int = 20) -> Array:
    """Return places along a polygonal outline: `count` places on each edge of the polygon."""
    ends = np.roll(outline, -1, axis=0)
    shares = np.arange(count) / count
    return np.concatenate(
        [one + shares[:, np.newaxis] * (end - one) for one, end in zip(outline, ends, strict=True)]
    )


def turning_number(touches: Array, centre: Array) -> int:
    """Connect all touches in order, and the last touch with the first. Returns how many times this path goes around
    `centre`.
    """
    turns = np.unwrap(np.arctan2(*(np.concatenate((touches, touches[:1])) - centre).T))
    return round(float(turns[-1] - turns[0]) / (2 * np.pi)) if len(touches) else 0


def _within(outline: Array) -> Array:
    """Return a place inside an outline, beside the middle of its longest side."""
    way = np.roll(outline, -1, axis=0) - outline
    side = int(np.hypot(*way.T).argmax())
    middle, aside = outline[side] + way[side] / 2, np.array([-way[side][1], way[side][0]])
    aside *= _DEEP / np.hypot(*aside)
    return np.asarray(middle + aside if _inside(middle + aside, outline) else middle - aside)


def _inside(at: Array, outline: Array) -> bool:
    ends = np.roll(outline, -1, axis=0)
    crosses = (outline[:, 1] > at[1]) != (ends[:, 1] > at[1])
    with np.errstate(divide="ignore", invalid="ignore"):
        x = outline[:, 0] + (at[1] - outline[:, 1]) * (ends - outline)[:, 0] / (ends - outline)[:, 1]
    return bool(np.count_nonzero(crosses & (at[0] < x)) % 2)
