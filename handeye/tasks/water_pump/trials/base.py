"""Trial of vision: locate the pump base on the belt."""

import math
from collections.abc import Iterator, Sequence
from typing import Final, Literal

import numpy as np

from handeye.core.errors import CalibrationFailed
from handeye.core.record import Vector3
from handeye.core.units import DEGREE, INCH
from handeye.core.variation import WorldSpec
from handeye.program.diagnosis.cause_text import cause_sentence
from handeye.tasks.trial import Attempt, Count, Known, Trial
from handeye.tasks.water_pump.trials.still_pump import (
    StillPump,
    base_poses,
    known_camera,
    locate,
    pump_base,
    put_base,
)  # fmt: skip
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.vision.base import Failure
from handeye.vision.hole_search import hole_places

WITHIN: Final = (INCH / 3, INCH / 4)  # accuracy of vision according to the paper, along x and along y
WRONG_BEYOND_PX: Final = 5.0
"""No error of the camera explains an offset greater than this (pixels). If the offset is greater, vision took
something else for the hole.
"""


class BaseAttempt(Attempt, frozen=True, kw_only=True):
    """One attempt to locate the base."""

    error: Vector3 | None  # error of x, y (m) and yaw (rad); None: the base was not found
    wrong: bool = False  # something else was taken for the base
    failure: str | None = None  # why it was not found, or the camera could not be calibrated

    @property
    def within(self) -> bool:
        """True if the base was located with the accuracy that the paper states."""
        return self.error is not None and all(abs(e) <= w for e, w in zip(self.error, WITHIN, strict=False))


class BaseTrial(Trial[BaseAttempt]):
    """Locate the base, first at its pose in the world, then at random poses on the belt."""

    attempt = BaseAttempt

    def attempts(self, world: WorldSpec, number: int, *, camera: str, known: Known) -> Iterator[BaseAttempt]:
        still, part = StillPump(PumpWorld.draw(world), renderer=camera), pump_base()
        poses = list(base_poses(still.world, number))
        try:
            model = known_camera(still, known, camera, part.at[:3])
        except CalibrationFailed as error:
            for k in range(number):
                yield BaseAttempt(seed=world.seed, number=k, error=None, failure=str(error))
            return
        for k, (x, y, yaw) in enumerate(poses):
            put_base(still, (x, y, part.at[2], yaw), pins=False)
            found, _ = locate(still.camera, model, part)
            if isinstance(found, Failure):
                yield BaseAttempt(seed=world.seed, number=k, error=None, failure=cause_sentence(found.cause))
                continue
            seen = [(hole.u, hole.v) for hole in found.holes]
            off_px = np.hypot(*(still.camera.shown(hole_places(part, (x, y, yaw))) - seen).T)
            wrong = bool(off_px.max() > WRONG_BEYOND_PX)
            dx, dy, turn = (a - b for a, b in zip(found.pose, (x, y, yaw), strict=True))
            off = dx, dy, math.remainder(turn, 2 * math.pi)
            yield BaseAttempt(seed=world.seed, number=k, error=off, wrong=wrong)

    def sentence(self, attempt: BaseAttempt) -> str:
        if attempt.error is None:
            return attempt.failure or "not found"
        x, y, turn = attempt.error
        off = f"x {x / INCH:+.3f} in, y {y / INCH:+.3f} in, yaw {turn / DEGREE:+.2f} deg"
        return (
            f"something other than the hole was found, off by {off}"
            if attempt.wrong
            else f"found, off by {off}"
        )

    def outcome(self, attempt: BaseAttempt) -> Literal["right", "missed", "wrong"]:
        return "wrong" if attempt.wrong else "missed" if attempt.error is None else "right"

    def count(self, attempts: Sequence[BaseAttempt]) -> Count:
        errors = np.array([a.error for a in attempts if a.error is not None]).reshape(-1, 3)
        tried, found, wrong = len(attempts), len(errors), sum(a.wrong for a in attempts)
        within = sum(a.within for a in attempts)
        x, y, turn = rms = [math.sqrt(float(np.mean(column**2))) if found else 0.0 for column in errors.T]
        return Count(
            figures={"tried": tried, "found": found, "wrong": wrong, "within": within, "rms": rms},
            lines=(
                f"found {found} of {tried}, {wrong} of them wrong",
                f"{within} within {WITHIN[0] / INCH:.2f} inches along x and {WITHIN[1] / INCH:.2f} inches along y",
                f"rms error: x {x / INCH:.3f} in, y {y / INCH:.3f} in, yaw {turn / DEGREE:.2f} deg",
            ),
            wrong=wrong,
        )
