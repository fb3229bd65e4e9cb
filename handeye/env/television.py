"""The television camera of an episode: its mechanism is slow, but the arm need not wait for the mechanism."""

from collections.abc import Mapping
from typing import Final

import numpy as np

from handeye.env.spaces import SWITCHED, Observation
from handeye.execution.drive import ArmDrive
from handeye.ports.camera import CLOSE_UP, COLUMNS, DIGITISE, ROWS, WIDE, Picture, TvCamera

NONE_YET: Final = -1.0  # age of the picture before the first one, s
FARTHEST: Final = 0.01  # reciprocal of the greatest distance at which the camera is focused, 1/m


class Television:
    """Executes the camera commands in the policy's actions, and holds the last picture."""

    def __init__(self, drive: ArmDrive, camera: TvCamera, ready: float) -> None:
        """Begin an episode. The mechanism of the camera comes to rest at the time `ready` (s on the cell's clock)."""
        self._drive, self._camera, self._ready = drive, camera, ready
        self._due: float | None = None  # time at which the picture that was asked for is digitised
        self._held = False
        self._picture: Picture = np.zeros((ROWS, COLUMNS), dtype=np.uint8)
        self._taken: float | None = None

    def command(self, values: Mapping[str, float]) -> None:
        """Carry out the camera commands of an action. Call this method before the action's servo period."""
        now = self._drive.cell.clock.now
        took = 0.0
        if values["set_lens"] > SWITCHED:
            took += self._camera.lens(CLOSE_UP if values["close_up"] > SWITCHED else WIDE)
        if values["set_aim"] > SWITCHED:
            took += self._camera.aim(values["pan"], values["tilt"])
        if values["set_focus"] > SWITCHED:
            took += self._camera.focus(1 / max(values["focus"], FARTHEST))
        if took:
            self._ready = max(self._ready, now) + took
        if values["look"] > SWITCHED and self._due is None:
            self._held = values["hold_target"] > SWITCHED
            self._due = max(self._ready, now) + DIGITISE

    def expose(self) -> None:
        """After a servo period, take the requested picture if the picture is due."""
        now = self._drive.cell.clock.now
        if self._due is not None and now >= self._due - self._drive.period / 2:
            self._picture, self._taken, self._due = self._camera.digitise(hold_target=self._held), now, None

    def seen(self) -> Observation:
        """Return the readings of the mount (pan and tilt, rad), the last picture, and the age of this picture (s). The
        age is negative before the first picture.
        """
        age = NONE_YET if self._taken is None else self._drive.cell.clock.now - self._taken
        camera = np.array(self._camera.pots())
        return {"camera": camera, "picture": self._picture.copy(), "picture_age": np.array([age])}
