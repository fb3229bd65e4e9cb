"""Worlds of the pump as they were always drawn: all quantities from one generator, in a fixed order."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from handeye.pose import Array
from handeye.units import DEGREE, INCH, OUNCE_FORCE
from handeye.variation import Variation, World, WorldSpec

_STREAMS: Final = {"sensors": 1, "camera": 2, "trial.calibration": 73, "trial.gasket": 74}


@dataclass(frozen=True, slots=True, kw_only=True)
class OldWorld(World):
    """A world whose noise comes from numbered streams."""

    def generator(self, stream: str) -> np.random.Generator:
        return np.random.default_rng([self.spec.seed, 1973, _STREAMS[stream]])


class OldVariation(Variation):
    """Draws from one generator."""

    def draw(self, spec: WorldSpec) -> OldWorld:
        return OldWorld(spec=spec, values=super().draw(spec).values)

    def drawn(self, seed: int) -> Mapping[str, float]:
        values = dict(super().drawn(seed))  # what is not random, and the order
        rng = np.random.default_rng([seed, 1973])
        self._belt(rng, values)
        self._arm(rng, values)
        self._devices(rng, values)
        self._light(rng, values)
        self._parts(rng, values, len([name for name in values if name.startswith("thread_phase.")]))
        return values

    def _belt(self, rng: np.random.Generator, values: dict[str, float]) -> None:
        values["base.x"] = float(rng.uniform(41.5, 47.5)) * INCH
        values["base.y"] = float(rng.uniform(23.0, 33.0)) * INCH
        values["base.yaw"] = (90.0 + 30.0 * float(rng.uniform(-1, 1))) * DEGREE

    def _arm(self, rng: np.random.Generator, values: dict[str, float]) -> None:
        spreads = np.array([0.060, 0.055, 0.027, 0.13, 0.13, 0.27])
        _put(
            values, "arm.offset", _clipped(rng, 6) * spreads * [DEGREE, DEGREE, INCH, DEGREE, DEGREE, DEGREE]
        )
        _put(values, "arm.scale", _clipped(rng, 6) * np.array([0.11, 0.22, 0.11, 0.11, 0.22, 0.22]) / 100)
        _put(values, "arm.wave_phase", rng.uniform(0, 2 * np.pi, 6))
        _put(values, "arm.link_mass", _clipped(rng, 6) * 3.0 / 100)
        means = np.array([q.nominal for q in self.select("arm.friction")])
        _put(values, "arm.friction", means * rng.uniform(0.5, 1.5, 6))

    def _devices(self, rng: np.random.Generator, values: dict[str, float]) -> None:
        _put(values, "hand.switch_force", (2.0 + 0.4 * _clipped(rng, 2)) * OUNCE_FORCE, ("plus_y", "minus_y"))
        values["hand.gap_offset"] = float(_clipped(rng)) * 0.01 * INCH
        values["hand.gap_scale"] = float(_clipped(rng)) * 0.5 / 100
        _put(values, "camera.place", _clipped(rng, 3) * 0.15 * INCH, "xyz")
        _put(values, "camera.turn", _clipped(rng, 3) * 0.2 * DEGREE, ("pan", "tilt", "roll"))
        _put(values, "camera.focal_length", _clipped(rng, 2) * 0.4 / 100, ("25mm", "50mm"))

    def _light(self, rng: np.random.Generator, values: dict[str, float]) -> None:
        values["light.zenith"] = float(rng.uniform(5.0, 50.0)) * DEGREE
        values["light.azimuth"] = float(rng.uniform(-np.pi, np.pi))
        values["light.strength"] = float(rng.uniform(0.35, 0.85))
        values["light.ambient"] = float(rng.uniform(0.15, 0.40))

    def _parts(self, rng: np.random.Generator, values: dict[str, float], screws: int) -> None:
        for fixture in ("blocks", "pin_holder", "gasket_stand", "top_stand", "rack", "dispenser"):
            _put(values, f"fixtures.{fixture}", _clipped(rng, 2) * (0.02 * INCH), "xy")
            values[f"fixtures.{fixture}.yaw"] = float(_clipped(rng)) * 0.2 * DEGREE
        for hole in range(1, screws + 1):
            _put(values, f"holes.{hole}", _clipped(rng, 2) * (0.003 * INCH), "xy")
        values["part_mass"] = float(_clipped(rng)) * 2.0 / 100
        for rubbing in ("pad", "table", "part", "thread"):
            values[f"friction.{rubbing}"] = 15.0 / 100 * float(rng.uniform(-1, 1))
        _put(values, "thread_phase", rng.uniform(0, 2 * np.pi, screws))


def _clipped(rng: np.random.Generator, size: int | None = None) -> Array:
    """Standard normal values clipped at two sigma."""
    return np.clip(rng.standard_normal(size), -2.0, 2.0)


def _put(values: dict[str, float], group: str, drawn: Array, names: Sequence[str] = "1234567") -> None:
    for name, value in zip(names, drawn, strict=False):
        assert f"{group}.{name}" in values
        values[f"{group}.{name}"] = float(value)
