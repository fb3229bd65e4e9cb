"""Trial of vision: check that the gasket lies correctly."""

import math
from collections.abc import Callable, Iterator, Sequence
from typing import Final, Literal

import numpy as np

from handeye.core.errors import CalibrationFailed
from handeye.core.pose import Pose, planar, translated, yaw
from handeye.core.units import DEGREE, INCH
from handeye.core.variation import WorldSpec
from handeye.ports.camera import CLOSE_UP
from handeye.program.program import Part
from handeye.tasks.stanford_cell.dimensions import base_top, dimensions, standard
from handeye.tasks.trial import Attempt, Count, Known, Trial
from handeye.tasks.water_pump.trials.still_pump import (
    Place,
    StillPump,
    known_camera,
    look,
    pump_base,
    put_base,
)  # fmt: skip
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.vision.camera_model import View
from handeye.vision.gasket import inspect

RIGHT: Final = "right"
SHIFTED: Final = "shifted .3"
ABSENT: Final = "absent"
DOUBLED: Final = "doubled"
REJECTED: Final = (SHIFTED, ABSENT)
"""Cases that vision must reject. `DOUBLED` is not one of them: a gasket on top of another looks like a single one, and
the hand detects the two by their height.
"""
SHIFT: Final = 0.3 * INCH
BASE_OFF_IN: Final = 0.03  # to either side, and .3 deg: the play of the base between the blocks
GASKET_OFF_IN: Final = 0.02  # likewise: the play of the gasket on the pins


class GasketAttempt(Attempt, frozen=True, kw_only=True):
    """The results of inspecting the gasket once in each case."""

    accepted: dict[str, bool]  # verdict of the eye by case; empty if the camera could not be calibrated
    failure: str | None = None


class GasketTrial(Trial[GasketAttempt]):
    """Inspect the gasket in four cases: correctly placed, shifted, absent, and doubled."""

    attempt = GasketAttempt

    def attempts(
        self, world: WorldSpec, number: int, *, camera: str, known: Known
    ) -> Iterator[GasketAttempt]:
        X_WP = standard()
        x, y, z = map(float, X_WP[:3, 3])
        still, part = StillPump(PumpWorld.draw(world), renderer=camera), pump_base((x, y, z, yaw(X_WP)))
        try:
            model = known_camera(still, known, camera, part.at[:3])
        except CalibrationFailed as error:
            for k in range(number):
                yield GasketAttempt(seed=world.seed, number=k, accepted={}, failure=str(error))
            return
        rng = still.world.generator("trial.gasket")
        for k in range(number):
            base = _jittered(part.at, rng, BASE_OFF_IN)
            put_base(still, base, pins=True)
            view = look(still.camera, model, CLOSE_UP, (x, y, z + part.face))
            yield GasketAttempt(seed=world.seed, number=k, accepted=_inspected(still, base, part, view, rng))

    def sentence(self, attempt: GasketAttempt) -> str:
        accepted = [case for case, ok in attempt.accepted.items() if ok]
        return attempt.failure or f"accepted: {', '.join(accepted) or 'none'}"

    def outcome(self, attempt: GasketAttempt) -> Literal["right", "missed", "wrong"]:
        if any(attempt.accepted.get(case) for case in REJECTED):
            return "wrong"
        return "right" if attempt.accepted.get(RIGHT) else "missed"

    def count(self, attempts: Sequence[GasketAttempt]) -> Count:
        tried = len(attempts)
        accepted = {case: sum(a.accepted.get(case, False) for a in attempts) for case in _CASES}
        return Count(
            figures={"tried": tried, "accepted": accepted},
            lines=tuple(f"{case:12} accepted {count} of {tried}" for case, count in accepted.items()),
            wrong=sum(accepted[case] for case in REJECTED),
        )


def _inspected(
    still: StillPump, base: Place, part: Part, view: View, rng: np.random.Generator
) -> dict[str, bool]:
    """Return the verdict of vision on the gasket in each case. Each picture is compared with a picture of the same
    view, taken before the gasket was placed.
    """
    before = still.camera.digitise()
    stand = still.pose("gasket")
    X_WP = planar(*base) @ planar(0.0, 0.0, base_top(), 0.0)
    accepted = {}
    for case, put in _CASES.items():
        X_WG = put(X_WP, rng)
        still.put("gasket", stand if X_WG is None else X_WG)
        after = still.camera.digitise(hold_target=True)
        accepted[case] = inspect(before, after, view, part, (part.at[0], part.at[1], part.at[3])).ok
    still.put("gasket", stand)
    return accepted


def _right(X_WP: Pose, rng: np.random.Generator) -> Pose:
    x, y, z = (float(value) for value in X_WP[:3, 3])
    return planar(*_jittered((x, y, z, yaw(X_WP)), rng, GASKET_OFF_IN))


def _shifted(X_WP: Pose, rng: np.random.Generator) -> Pose:
    way = rng.uniform(0, 2 * math.pi)
    return translated(X_WP, (SHIFT * math.cos(way), SHIFT * math.sin(way), 0.0))


def _doubled(X_WP: Pose, rng: np.random.Generator) -> Pose:
    """Return the pose of the upper of two gaskets. The lower gasket is hidden beneath the upper one."""
    return translated(_right(X_WP, rng), (0.0, 0.0, dimensions()("gasket.thickness")))


_CASES: Final[dict[str, Callable[[Pose, np.random.Generator], Pose | None]]] = {
    RIGHT: _right,
    SHIFTED: _shifted,
    ABSENT: lambda X_WP, rng: None,
    DOUBLED: _doubled,
}  # pose of the gasket on a base face at `X_WP`, by case; None: it stays on its stand


def _jittered(place: Place, rng: np.random.Generator, amount: float) -> Place:
    """Return a place that is changed at random: by at most `amount` inches along x and along y, and by at most .3
    degrees.
    """
    x, y, z, turn = place
    dx, dy = rng.uniform(-amount, amount, 2) * INCH
    return x + float(dx), y + float(dy), z, turn + float(rng.uniform(-0.3, 0.3)) * DEGREE
