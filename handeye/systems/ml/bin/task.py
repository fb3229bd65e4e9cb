"""Defines the job `bin`, its worlds and its referee."""

from __future__ import annotations

from collections.abc import Mapping
from itertools import product
from typing import TYPE_CHECKING, Final, Literal

import numpy as np
from numpy.typing import NDArray

from handeye.cell.mechanism import Mechanism
from handeye.core.diagnostics import quoted
from handeye.core.distributions import Fixed, Noise, Range
from handeye.core.errors import BadFile, NoSuchName
from handeye.core.faults import Catalogue
from handeye.core.record import Record
from handeye.core.variation import Variation, WorldSpec
from handeye.judge.finding import Findings, at_most
from handeye.systems.ml.bench.bars import DENSITY, WIDE, add_bar
from handeye.systems.ml.bench.hardware import ArmTask
from handeye.systems.ml.bench.reporting import Printed, ReportingHardware
from handeye.systems.ml.bench.station import Station, scene
from handeye.systems.ml.bench.world import ARM, ArmWorld, quantity
from handeye.systems.ml.bin.faults import EMPTY, FAULTS, TROUBLES
from handeye.systems.ml.bin.hopper import BOXES, ORIGIN, RIM, TRAY, add_boxes, add_hopper, hold_firmly
from handeye.systems.ml.machine.spec import LINEAR
from handeye.systems.ml.run.hardware import Hardware, Tell
from handeye.tasks.interface import Words
from handeye.tasks.stanford_cell.screws import Place

if TYPE_CHECKING:
    import mujoco

    from handeye.cell.bench import Bench
    from handeye.cell.truth import Truth
    from handeye.core.pose import Array
    from handeye.systems.ml.run.plan import MlPlan

Quality = Literal["good", "narrow", "light"]
POURED = "poured"
USUAL: Final = 8  # parts
MOST: Final = 12
NARROW: Final = 0.001  # m by which a narrow part is narrower than a good one
_WIDER: Final = 0.003  # m by which a part of another kind is wider than a good one
_STEEL: Final = 2.9  # weight of a steel part, as a multiple of that of an aluminium part
LIGHT: Final = 0.5  # weight of a light part, as a share of a good one's
_ASIDE: Final = 0.028  # m of the poured parts from the middle, along x and y
_LAYER: Final = 0.055  # m from one layer of four parts to the next
_SETTLING: Final = 2000  # steps of 1 ms
_LOWEST: Final = 0.045  # m: height of the lowest layer over the table
_WRONG, _SIZE, _FRICTION, SMOOTH = "parts.wrong", "parts.size", "parts.friction", "hopper.friction"
PARTS: Final = (
    quantity(
        _WRONG,
        "",
        Fixed(0.25),
        1.0,
        "Probability that a part is bad: 1 mm too narrow, or half as heavy as a good one. No source: our choice.",
    ),
    quantity(_SIZE, "mm", Noise(0.05), 0.2, "Standard deviation of a part's width. No source: our choice."),
    quantity(
        _FRICTION,
        "",
        Range(0.3, 0.4),
        2.0,
        "Coefficient of friction between parts. No source: our choice.",
        0.35,
    ),
    quantity(
        SMOOTH,
        "",
        Range(0.10, 0.18),
        2.0,
        "Coefficient of friction between parts and hopper. No source: our choice, for a polished lining. If the "
        "coefficient were .22 or more, parts would stay on the slopes of the hopper.",
        0.14,
    ),
)
VARIATION: Final = Variation(*ARM, *PARTS)


class Poured(Record, frozen=True, kw_only=True):
    """The true qualities of the parts, as they were before the program began."""

    qualities: tuple[Quality, ...]


class Pile(Mechanism[Poured]):
    """Remembers the true qualities of the parts that were poured into the bin. Only the referee sees the qualities."""

    name, kind = POURED, Poured

    def __init__(self, poured: Poured) -> None:
        self.poured = poured

    def state(self) -> Poured:
        return self.poured

    def check(self, state: Poured) -> None:
        if state != self.poured:
            raise BadFile(
                "the parts in the bin of the saved run differ from the parts in the bin of this world"
            )

    def restore(self, state: Poured) -> None:
        self.poured = state


class Sorter(ReportingHardware):
    """A station whose program counts good and bad parts."""

    def counted(self, count: str) -> str:
        good, bad = told(count)
        return f"in the boxes: {good} good and {bad} bad"

    @property
    def figures(self) -> Mapping[str, float]:
        lines = self.heard
        good, bad = told(lines[-1].partition(" ")[2] if lines else "")
        return {"told_good": good, "told_bad": bad}


class Bin(ArmTask):
    """Take parts out of a bin, and sort them into boxes."""

    name = "bin"
    words = Words(product="the sorted parts", done="The bin is empty, and each part is in its box.")

    def variation(self) -> Variation:
        return VARIATION

    def faults(self, world: WorldSpec) -> Catalogue:
        return FAULTS

    def station(self, parts: int, world: ArmWorld) -> Station:
        """Return the station with two boxes and a hopper. The parts fall into the hopper when the simulation begins."""
        spec = scene(world, wand=False)
        add_hopper(spec, world.value(SMOOTH))
        add_boxes(spec)
        hold_firmly(spec)
        if world.fault(EMPTY) is not None:
            parts = 0
        return Station(spec, world, at={4: BOXES["good"]}, others=(poured(spec, world, parts),))

    def scene(self, spec: WorldSpec) -> mujoco.MjModel:
        return settled(self.station(USUAL, self.world(spec)).bench)

    def recorded_scene(self, spec: WorldSpec, plan: bytes) -> mujoco.MjModel:
        from handeye.systems.ml.run.plan import decode

        return self.station(parts_of(decode(plan, "the plan of the run")), self.world(spec)).bench.model

    def hardware(self, plan: MlPlan, world: WorldSpec, tell: Tell) -> Hardware:
        return Sorter(self.station(parts_of(plan), self.world(world)), tell, TROUBLES)

    def judge(self, truth: Truth) -> Findings:
        poured, heard = truth.states[POURED], truth.states["heard"]
        assert isinstance(poured, Poured)
        assert isinstance(heard, Printed)
        parts = range(1, len(poured.qualities) + 1)
        places = np.array([truth.data.body(f"part_{n}").xpos for n in parts]).reshape(-1, 3)
        good = np.array([quality == "good" for quality in poured.qualities], dtype=np.bool_)
        boxed = {name: _inside(places, x * LINEAR, TRAY) for name, x in BOXES.items()}
        left = _inside(places, 0.0, (RIM, RIM))
        out = ~(left | boxed["good"] | boxed["bad"])
        counted = told(heard.lines[-1].partition(" ")[2] if heard.lines else "")
        here = int(boxed["good"].sum()), int(boxed["bad"].sum())
        return {
            "passed": at_most(int((boxed["good"] & ~good).sum()), 0, "parts", "bad parts in the box for good ones"),
            "rejected": at_most(int((boxed["bad"] & good).sum()), 0, "parts", "good parts in the box for bad ones"),
            "left": at_most(int(left.sum()), 0, "parts", "parts left in the bin"),
            "lost": at_most(int(out.sum()), 0, "parts", "parts that lie elsewhere"),
            "told": at_most(
                max(abs(one - other) for one, other in zip(counted, here, strict=True)), 0, "parts",
                "greatest difference between the printed and the true number of parts in a box",
            ),
        }  # fmt: skip


def poured(spec: mujoco.MjSpec, world: ArmWorld, parts: int, place: Place = ORIGIN) -> Pile:
    """Put parts above a hopper. When the simulation begins, the parts fall into the hopper.

    Args:
        place: where the middle of the hopper is in the scene (m).
    """
    qualities = tuple(_quality(world, number) for number in range(1, parts + 1))
    places = product((_LOWEST + n * _LAYER for n in range(3)), (-1, 1), (-1, 1))
    for number, (quality, (z, x, y)) in enumerate(zip(qualities, places, strict=False), 1):
        wide = WIDE + world.normal(f"part_{number}.size", _SIZE) - NARROW * (quality == "narrow")
        wide += _WIDER * (world.fault(f"part_{number}.wide") or 0.0)
        heavy = _STEEL if world.fault(f"part_{number}.heavy") is not None else 1.0
        turn = world.numbers(f"part_{number}.turned").standard_normal(4)
        at = np.array([place.x + x * _ASIDE, place.y + y * _ASIDE, z])
        add_bar(
            spec, f"part_{number}", at, turn / np.linalg.norm(turn), world.value(_FRICTION), wide=wide,
            density=DENSITY * heavy * (LIGHT if quality == "light" else 1.0), soft=True,
        )  # fmt: skip
    return Pile(Poured(qualities=qualities))


def settled(bench: Bench) -> mujoco.MjModel:
    """Simulate until the parts on a bench are at rest. Return the scene in this state, for pictures."""
    import mujoco

    mujoco.mj_step(bench.model, bench.data, _SETTLING)
    bench.model.qpos0[:] = bench.data.qpos
    return bench.model


def told(count: str) -> tuple[int, int]:
    """Return the numbers of good and of bad parts that a program has printed. A missing number counts as 0."""
    good, bad, *_ = *map(int, count.split()), 0, 0
    return good, bad


def parts_of(plan: MlPlan) -> int:
    """Return the number of parts that a plan puts into the bin. Raises NoSuchName if the number is not from 1 to
    `MOST`.
    """
    if plan.variant.isdecimal() and 1 <= int(plan.variant) <= MOST:
        return int(plan.variant)
    raise NoSuchName(f"the bin holds 1 to {MOST} parts, not {quoted(plan.variant)}")


def _quality(world: ArmWorld, number: int) -> Quality:
    drawn = world.numbers(f"part_{number}.quality").uniform()
    if drawn >= world.value(_WRONG):
        return "good"
    return "narrow" if drawn < world.value(_WRONG) / 2 else "light"


def _inside(places: Array, x: float, half: tuple[float, float]) -> NDArray[np.bool_]:
    """Return True for each place inside a rectangle. The middle of the rectangle is at (x, 0), and its half sides are
    `half`.
    """
    return np.asarray((np.abs(places[:, :2] - [x, 0.0]) < half).all(axis=1), dtype=np.bool_)


BIN: Final = Bin()
