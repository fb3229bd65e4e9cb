"""The referee of the rail support. It judges whether the parts are in their places, the screws in their threads, and
the screwdriver in its rack.
"""

from math import degrees, hypot
from typing import Final

import numpy as np

from handeye.cell.threads import Threads
from handeye.cell.truth import Truth
from handeye.core.units import MILLIMETRE
from handeye.judge.finding import Findings, at_least, at_most
from handeye.judge.measured import tilt
from handeye.systems.ml.support.drawing import (
    FRAME,
    NEST,
    PARTS,
    PIN_DEPTH,
    PIN_PLACES,
    PINS,
    RACK,
    RACK_HEIGHT,
    RAIL_X,
    RAILS,
    ROWS,
    SADDLE,
    SADDLES,
    SCREWS,
    mm,
)
from handeye.tasks.stanford_cell.screws import LENGTH, Place

PLACED: Final = 1.5
"""Greatest distance (mm) of a part from its place in the frame, and of the frame from its place in the nest. In a
direction without a stop, the errors of the fixtures and of two motions, and the play of pallets and nest, can add up
to 1.3 mm.
"""
SEATED: Final = 0.5  # mm: greatest height of a part over its seat
LEAN: Final = 1.0  # deg
HEAD_GAP: Final = 0.2  # mm: greatest gap under a head, as for the pump
CLAMP: Final = 100.0  # N: least clamping force
STRAIN: Final = 420.0  # N: greatest clamping force, as for the pump
RACKED: Final = 1.0  # mm


def judge(truth: Truth, counted: int) -> Findings:
    """Compare the truth with the drawing, and with the number of parts that the program has counted."""
    screws = _Screws(truth)
    rights = [
        _in_frame(truth, name, at, FRAME[2])
        for names, places in (
            (RAILS, [mm(side * RAIL_X, 0) for side in (-1, 1)]),
            (SADDLES, [mm(0, y) for y in ROWS]),
        )
        for name, at in zip(names, places, strict=True)
    ]
    pins = [min(_in_frame(truth, name, mm(*at), FRAME[2] - PIN_DEPTH) for at in PIN_PLACES) for name in PINS]
    frame = _off(truth, "frame", mm(*NEST), 0.0)
    offs = np.array([frame, *rights, *pins])
    right = int((offs <= (PLACED, SEATED, LEAN)).all(axis=1).sum()) + screws.right
    far, high, lean = offs.max(axis=0).tolist()
    driver = _off(truth, "driver", mm(*RACK), RACK_HEIGHT)
    return {
        "placed": at_most(far, PLACED, "mm", "greatest distance of a part from its place"),
        "seated": at_most(high, SEATED, "mm", "greatest error of a part's height"),
        "upright": at_most(lean, LEAN, "deg", "greatest tilt of a part"),
        "screws": at_least(screws.taken, SCREWS, "screws", "number of threads whose screw is not crossed"),
        "screws_depth": at_most(screws.gap, HEAD_GAP, "mm", "greatest gap under the head of a screw"),
        "screws_clamp": at_least(screws.weakest, CLAMP, "N", "smallest clamping force of a screw"),
        "screws_strain": at_most(screws.strongest, STRAIN, "N", "greatest clamping force of a screw"),
        "counted": at_most(
            abs(counted - right),
            0,
            "parts",
            "difference between the program's count and the number of parts in place",
        ),
        "parts": at_least(right, PARTS, "parts", "parts in place"),
        "rack": at_most(
            max(driver[:2]), RACKED, "mm", "distance of the screwdriver from its place in the rack"
        ),
    }


def _off(truth: Truth, name: str, at: Place, z: float) -> tuple[float, float, float]:
    """Return how far a body is from its place: sideways (mm), in height (mm), and in tilt (deg)."""
    body = truth.data.body(name)
    x, y, height = body.xpos / MILLIMETRE
    return hypot(x - at.x, y - at.y), abs(height - z), degrees(tilt(body.xmat.reshape(3, 3)))


def _in_frame(truth: Truth, name: str, at: Place, z: float) -> tuple[float, float, float]:
    """Return how far a part is from its place in the frame: sideways (mm), in height (mm), and in tilt (deg)."""
    frame, part = truth.data.body("frame"), truth.data.body(name)
    axes = frame.xmat.reshape(3, 3)
    x, y, height = (part.xpos - frame.xpos) @ axes / MILLIMETRE
    return hypot(x - at.x, y - at.y), abs(height - z), degrees(tilt(axes.T @ part.xmat.reshape(3, 3)))


class _Screws:
    """The screws in their threads."""

    def __init__(self, truth: Truth) -> None:
        (threads,) = (part for part in truth.mechanisms if isinstance(part, Threads))
        self.taken = self.right = 0
        self.gap, self.weakest, self.strongest = 0.0, np.inf, 0.0
        for number, thread in enumerate(threads.holes):
            good = thread.screw is not None and not thread.crossed
            gap, clamp = LENGTH, 0.0
            if thread.screw is not None:
                carrier, seat = truth.data.body(f"carrier{number}"), truth.data.body(SADDLES[number // 2])
                axis, up = carrier.xmat.reshape(3, 3)[:, 2], seat.xmat.reshape(3, 3)[:, 2]
                gap = (
                    float((carrier.xpos - seat.xpos) @ up) / MILLIMETRE
                    + LENGTH * float(axis @ up)
                    - SADDLE[2]
                )
                clamp = threads.head_force(number)
            self.gap = max(self.gap, gap)
            self.weakest, self.strongest = min(self.weakest, clamp), max(self.strongest, clamp)
            self.taken += good
            self.right += good and gap <= HEAD_GAP and CLAMP <= clamp <= STRAIN
