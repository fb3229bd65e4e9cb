"""A simulated lamp: a frosted bulb, dull when it is off."""

from typing import Final

import mujoco

from handeye.cell.mechanism import Mechanism
from handeye.cell.signal_lines import SOUND, SignalLines
from handeye.core.record import Record
from handeye.ports.lamp import LampPort


class LampState(Record, frozen=True, kw_only=True):
    """State of a lamp."""

    lit: bool


class SimulatedLamp(Mechanism[LampState], LampPort):
    """A lamp that is a material of the MuJoCo model."""

    kind = LampState
    changes = ("mat_rgba", "mat_emission")

    _LIT: Final = ((1.0, 0.96, 0.85, 1.0), 1.0)

    def __init__(self, model: mujoco.MjModel, material: str, lines: SignalLines = SOUND) -> None:
        """A lamp that is off; its line is `lamp`."""
        self.name = material
        self._lines = lines
        self._model = model
        self._material = model.material(material).id
        self._dark = (tuple(model.mat_rgba[self._material]), 0.0)
        self._lit = False

    def switch(self, lit: bool) -> None:
        self._lit = lit

    def before(self, seconds: float) -> None:
        rgba, emission = self._LIT if self._lines.carried("lamp", float(self._lit)) else self._dark
        self._model.mat_rgba[self._material] = rgba
        self._model.mat_emission[self._material] = emission

    def state(self) -> LampState:
        return LampState(lit=self._lit)

    def restore(self, state: LampState) -> None:
        self._lit = state.lit
