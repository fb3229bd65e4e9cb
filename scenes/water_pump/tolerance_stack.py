"""Computes in how many worlds six screws pass through gasket and top, for the placements that the aligning pins allow.

    python scenes/water_pump/tolerance_stack.py [WORLDS]

The sizes come from dimensions.toml, and the errors from the pump's table of quantities. There is no physics. In each
world, the tapped holes and the holes of both layers (gasket and top) are drilled, each with its own errors. Two pins
stand in tapped holes, with play and tilt. The hand lays each layer down, rotated and displaced by the errors of the
joints and the steps of their potentiometers. The layer then takes the nearest placement in which both pins are within
its holes. A screw stands upright on the axis of its tapped hole. It meets a layer if the distance between this axis and
the axis of the layer's hole is greater than the difference of their radii.

The worst placement is computed in a tenth of the worlds: of all placements that the pins allow, the one with the
largest error of a hole.

"As met" adds to the play of a pin what the simulation adds: its pins are polygons, and its contacts are soft.
"""

import sys
from collections.abc import Iterator
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from handeye.arm.ik import solve
from handeye.arm.kinematics import forward
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.device_errors import ArmErrors
from handeye.core.pose import Array, hand
from handeye.core.units import UNITS
from handeye.tasks.stanford_cell.arm_variation import ARM_CENTRE, ARM_PERIOD, JOINT_UNITS
from handeye.tasks.stanford_cell.dimensions import PARK, dimensions, screw_holes, standard
from handeye.tasks.water_pump.world.variation import variation

WORLDS: Final = 100_000
SOFT: Final = 5e-5  # m, additional play of a pin in the simulation; measured: .03 to .05 mm
SWEEPS: Final = (
    60  # iterations to find a layer's placement between two pins; after 30, none moves by a micrometre
)
DIRECTIONS: Final = (
    12  # number of directions in which each pin pushes a layer, in the search for the worst placement
)
LAYERS: Final = ("gasket", "top")


@dataclass(frozen=True, slots=True, kw_only=True)
class Sizes:
    """Sizes that determine whether screws pass through a layer (m)."""

    hole: float
    """Radius of the layer's screw holes."""
    height: float
    """Height of the upper end of the layer's holes above the base's face."""
    nose: float
    body: float
    """Radii of a pin: `nose` is in the base, `body` in the layer."""
    tap: float
    """Radius of a tapped hole."""
    guide: float
    """Length over which a tapped hole guides a pin's nose."""
    mouth: float
    """Depth at which this length begins."""
    shank: float
    """Radius of a screw."""

    @classmethod
    def drawn(cls, layer: str) -> "Sizes":
        """Return the sizes of gasket or top, as drawn."""
        d = dimensions()
        height = d("gasket.thickness")
        if layer == "top":
            height += d("top.flange") - d("top.chamfer_above")
        chamfer = d("base.screw_holes.chamfer")
        return cls(
            hole=d(f"{layer}.screw_hole_radius"), height=height,
            nose=d("pin.nose_radius"), body=d("pin.body_radius"), tap=d("base.screw_holes.radius"),
            guide=d("pin.nose_length") - d("pin.nose_bevel") - chamfer, mouth=chamfer,
            shank=d("screw.shank_radius"),
        )  # fmt: skip

    @property
    def clearance(self) -> float:
        """Greatest distance between the axes of a screw and its hole at which the screw passes."""
        return self.hole - self.shank

    @property
    def play(self) -> float:
        """Greatest distance that a pin allows between a layer's hole and its tapped hole: play and tilt of the pin in
        the tapped hole, and play of the layer on the pin.
        """
        aside = self.tap - self.nose
        return aside + 2 * aside * (self.height + self.mouth) / self.guide + self.hole - self.body


@dataclass(frozen=True, slots=True, kw_only=True)
class Stack:
    """The results. Arrays have one value per world."""

    clearance: float
    play: float
    binds: Array
    """True if the pins do not fit into the layer's holes together."""
    laid: Array
    """Greatest distance between the axes of a screw and its hole, in the placement that the layer takes (m)."""
    worst: Array
    """The same distance in the worst placement, in a tenth of the worlds."""


def stack(sizes: Sizes, layer: str, worlds: int, seed: int = 1973) -> Stack:
    """Draw worlds, and compute the placement of a layer in each."""
    rng = np.random.default_rng([seed, LAYERS.index(layer)])
    holes = np.array(screw_holes())
    wrong = _drilling(layer, worlds, rng) - _drilling("base", worlds, rng)
    pinned = np.array(dimensions().all("base.screw_holes.pinned"), int)
    about = holes - holes[pinned].mean(axis=0)
    place = _between(about[pinned], wrong[:, pinned], sizes.play, _hand(layer, worlds, rng))
    at_pins = _off(about[pinned], wrong[:, pinned], place)
    return Stack(
        clearance=sizes.clearance,
        play=sizes.play,
        binds=at_pins.max(axis=1) > sizes.play + 1e-5,
        laid=_off(about, wrong, place).max(axis=1),
        worst=_worst(about, wrong[: -(-worlds // 10)], pinned, sizes.play),
    )


def _drawn(name: str, worlds: int, rng: np.random.Generator) -> Array:
    """Draw a normally distributed quantity in many worlds at once (SI). The values are clipped in the same way as in
    worlds.
    """
    quantity = variation().quantities[name]
    sigma = quantity.distribution.spread * quantity.measure.size
    return np.asarray(sigma * np.clip(rng.standard_normal(worlds), -2.0, 2.0))


def _drilling(part: str, worlds: int, rng: np.random.Generator) -> Array:
    """Draw the errors of a part's screw holes, shape (worlds, 6, 2)."""
    names = [[f"holes.{part}.{k}.{axis}" for axis in "xy"] for k in range(1, 7)]
    return np.stack([np.stack([_drawn(n, worlds, rng) for n in pair], -1) for pair in names], 1)


def _hand(layer: str, worlds: int, rng: np.random.Generator) -> Array:
    """Draw where the hand lays a layer, relative to the base: x, y and rotation, shape (worlds, 3)."""
    X_WT = standard() @ hand(*{"gasket": (0.04, 0.0), "top": (0.0, 0.0)}[layer], 0.1, 0.0, np.pi / 2, 0.0)
    target = solve(STANFORD, X_WT, PARK).q
    assert target is not None
    arm = _arm(worlds, rng)
    read = target + arm.pot_step * rng.uniform(
        -0.5, 0.5, (worlds, 6)
    )  # all positions within a step give the same reading
    X = forward(STANFORD, arm.positions(read))
    R = X[:, :3, :3] @ X_WT[:3, :3].T
    turn = np.arctan2(R[:, 1, 0], R[:, 0, 0]) - _drawn("fixtures.blocks.yaw", worlds, rng)
    return np.column_stack([X[:, :2, 3] - X_WT[:2, 3], turn])


def _arm(worlds: int, rng: np.random.Generator) -> ArmErrors:
    """Draw the arms of many worlds at once."""
    size = np.array([UNITS[unit].size for unit in JOINT_UNITS])

    def joints(name: str) -> Array:
        return np.stack([_drawn(f"arm.{name}.{k}", worlds, rng) for k in range(1, 7)], -1)

    wave, step = (
        np.array([variation().quantities[f"arm.{name}.{k}"].distribution.spread for k in range(1, 7)]) * size
        for name in ("wave", "pot_step")
    )
    return replace(
        ArmErrors.none(6), offset=joints("offset"), scale=joints("scale"), wave=wave, pot_step=step,
        period=np.array(ARM_PERIOD) * size, phase=rng.uniform(0.0, 2 * np.pi, (worlds, 6)),
        centre=np.array(ARM_CENTRE) * size,
    )  # fmt: skip


def _moved(about: Array, place: Array) -> Array:
    """Return the displacements of points of a layer in a placement, shape (worlds, points, 2)."""
    x, y = about.T
    turn = place[:, 2:]
    return np.stack([place[:, :1] - turn * y, place[:, 1:2] + turn * x], -1)


def _off(about: Array, wrong: Array, place: Array) -> Array:
    """Return the distances of a layer's holes from the tapped holes, shape (worlds, points)."""
    return np.asarray(np.linalg.norm(_moved(about, place) + wrong, axis=-1))


def _between(about: Array, wrong: Array, play: float, laid: Array) -> Array:
    """Return the placement nearest to `laid` that both pins allow. In turn, each pin pulls its hole towards itself."""
    place = laid.copy()
    for _ in range(SWEEPS):
        for k, (x, y) in enumerate(about):
            at = _moved(about[k : k + 1], place)[:, 0] + wrong[:, k]
            way = np.linalg.norm(at, axis=1, keepdims=True)
            pull = -at * np.maximum(1 - play / np.maximum(way, 1e-12), 0.0) / 2
            place[:, :2] += pull
            place[:, 2] += (x * pull[:, 1] - y * pull[:, 0]) / (x * x + y * y)
    return place


def _worst(about: Array, wrong: Array, pinned: Array, play: float) -> Array:
    """Return the greatest distance of any hole in the worst placement that two pins allow, shape (worlds,)."""
    worst = np.zeros(len(wrong))
    for place in _pushed(about[pinned], wrong[:, pinned], play):
        allowed = _off(about[pinned], wrong[:, pinned], place).max(axis=1) < play + 5e-6
        worst = np.maximum(worst, np.where(allowed, _off(about, wrong, place).max(axis=1), 0.0))
    return worst


def _pushed(about: Array, wrong: Array, play: float) -> Iterator[Array]:
    """Yield placements in which each pin has pushed the layer in some direction as far as possible."""
    along = about[1] - about[0]
    length = np.hypot(*along)
    across = np.array([-along[1], along[0]]) / length
    angles = 2 * np.pi * np.arange(DIRECTIONS) / DIRECTIONS
    directions = play * np.column_stack([np.cos(angles), np.sin(angles)])
    for first in directions:
        for second in directions:
            ends = first - wrong[:, 0], second - wrong[:, 1]
            yield np.column_stack([(ends[0] + ends[1]) / 2, (ends[1] - ends[0]) @ across / length])


def table(worlds: int) -> Iterator[str]:
    """Yield the lines of a table with the results for both layers, as drawn and as met."""
    yield f"{worlds:,} worlds: lengths in mm, and shares of the worlds"
    heads = f"{'clear':>7}{'play':>7}{'pins bind':>11}{'a screw meets':>15}{'worst place meets':>19}"
    yield f"{'':15}{heads}   farthest axis 50 / 99 / 99.99 / 100 %"
    for layer in LAYERS:
        drawn = Sizes.drawn(layer)
        for what, sizes in (("drawn", drawn), ("met", replace(drawn, body=drawn.body - SOFT))):
            yield f"{layer + ' as ' + what:15}" + _row(stack(sizes, layer, worlds))


def _row(found: Stack) -> str:
    shares = [found.binds, found.laid > found.clearance, found.worst > found.clearance]
    binds, meets, worst = (f"{share.mean():.0e}" if share.any() else "0" for share in shares)
    farthest = " / ".join(f"{value * 1e3:.3f}" for value in np.percentile(found.laid, [50, 99, 99.99, 100]))
    sizes = f"{found.clearance * 1e3:7.3f}{found.play * 1e3:7.3f}"
    return f"{sizes}{binds:>11}{meets:>15}{worst:>19}   {farthest}"


if __name__ == "__main__":
    for line in table(int(sys.argv[1]) if len(sys.argv) > 1 else WORLDS):
        print(line)
