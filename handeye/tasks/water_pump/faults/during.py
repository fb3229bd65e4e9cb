"""Faults that begin during a run: mishaps, caused by a person's hand or by chance.

Each mishap begins with a stage and lasts a stated time. A part that is taken away or lost is put on the tray below the
floor, where nothing touches it; the hand that takes it is not simulated. A push is modelled as a force. A hand that
moves the base is modelled as a spring between the base and a point that moves at constant speed. Friction carries
along the parts on the base.
"""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import replace
from functools import cache, partial
from typing import Final

import numpy as np

from handeye.cell.mechanism import Mechanism
from handeye.cell.state import finite
from handeye.core.errors import (
    FORCE_WRONG,
    GAP_WRONG,
    NOTHING_HELD,
    SEARCH_EXHAUSTED,
    SERVO_LAG,
)
from handeye.core.faults import ExpectedDetection, Fault, Size
from handeye.core.record import Record
from handeye.core.units import INCH
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.water_pump.faults import shared_expectations as detect
from handeye.tasks.water_pump.faults.declaration import broken, declared
from handeye.tasks.water_pump.faults.finished import faults_of_finished_work
from handeye.tasks.water_pump.faults.mishap import Mishap, MishapFault, MishapState, Scene, always

PUSH_S: Final = 2.0
MOVE_S: Final = 1.0
HAND: Final = (4000.0, 60.0, 150.0)
"""Stiffness (N/m), damping (N s/m) and greatest force (N) of the person's hand that moves the base. In a measurement
with these values, the base ended 2 mm short of its goal.
"""
LIFTED_M: Final = 0.02  # m; a part that has risen this far is held by the hand alone


class MishapsState(Record, frozen=True, kw_only=True):
    """The states of all mishaps of a run, in the order of the mishaps."""

    mishaps: tuple[MishapState, ...]


def _pushed(axis: int, force_N: float) -> Mishap:
    """Return a mishap in which the arm's hand is pushed along an axis of the table with a force (N)."""

    def act(scene: Scene, state: MishapState) -> bool:
        over = (state.seconds or 0.0) >= PUSH_S
        body = scene.model.body(f"{ARM}link6").id
        scene.data.xfrc_applied[body, axis] = 0.0 if over else force_N
        return over

    return Mishap(act)


def _moved(axis: int, way_m: float) -> Mishap:
    """Return a mishap in which the base is moved along an axis of the table by a distance (m)."""

    def act(scene: Scene, state: MishapState) -> bool:
        assert state.place is not None
        seconds, (spring, damper, most) = state.seconds or 0.0, HAND
        way = np.zeros(2)
        way[axis] = way_m
        goal = np.add(state.place[:2], way * (seconds / MOVE_S))
        away = goal - scene.place("base")[:2]
        late = way / MOVE_S - scene.data.qvel[scene.dofs("base")][:2]
        force = spring * away + damper * late
        force *= min(1.0, most / max(float(np.hypot(*force)), 1e-9))
        over = seconds >= MOVE_S
        scene.data.xfrc_applied[scene.model.body("base").id, :2] = 0.0 if over else force
        return over

    return Mishap(act, "base")


def _take_away(scene: Scene, _: MishapState) -> bool:
    """Take the base away with all parts on it."""
    way = scene.to_tray("base")
    for part in scene.stack():
        scene.shift(part, way)
    return True


def _lose(part: str, scene: Scene, state: MishapState) -> bool:
    """Take a part out of the hand as soon as the hand has lifted the part."""
    assert state.place is not None
    if scene.place(part)[2] < state.place[2] + LIFTED_M:
        return False
    scene.take(part)
    return True


def _put_out(scene: Scene, _: MishapState) -> bool:
    """Switch off the lamp of the cell; the ambient light remains."""
    scene.model.light_diffuse[:] = 0.0
    return True


@cache
def mishap_faults() -> tuple[MishapFault, ...]:
    """Return all mishaps, in the order of the catalogue."""
    return (*_light_and_pushes(), *_base(), *_losses(), *faults_of_finished_work())


def _light_and_pushes() -> Iterator[MishapFault]:
    meaning = "The lamp of the cell goes out; only the light of the room remains."
    yield declared("light.off", meaning, always(Mishap(_put_out)), detect.LATE_LIGHT, stage=6)
    size = Size(unit="N", usual=40.0, limits=(-300.0, 300.0))
    expected = ExpectedDetection(
        errors=(FORCE_WRONG, SERVO_LAG),
        calls=(detect.ASTRAY,),
        harmless="The drives withstand a push that ends before the next guarded motion.",
    )
    for number, axis in enumerate("xyz"):
        meaning = f"A person pushes the hand along table {axis} with this force for {PUSH_S:g} s."
        yield declared(f"arm.pushed.{axis}", meaning, partial(_pushed, number), expected, size, stage=3)


def _base() -> Iterator[MishapFault]:
    size = Size(unit="in", usual=1.0, limits=(-6.0, 6.0))
    expected = ExpectedDetection(
        errors=(SEARCH_EXHAUSTED, NOTHING_HELD),
        calls=(detect.NOT_WHERE_SEEN, detect.PUMP_ASTRAY, detect.OR_PUMP),
        harmless="The hand searches for the base around the place where the camera saw it.",
    )
    for number, axis in enumerate("xy"):
        meaning = (
            f"Within {MOVE_S:g} s, a person moves the base, with everything on it, by this distance along"
            f" table {axis}."
        )
        yield declared(f"base.moved.{axis}", meaning, partial(_moved, number), expected, size, stage=2)
    meaning = "A person removes the base with everything on it."
    gone = ExpectedDetection(
        errors=(SEARCH_EXHAUSTED,), calls=(detect.NO_BASE, detect.PUMP_ASTRAY, detect.OR_PUMP)
    )
    yield declared("base.removed", meaning, always(Mishap(_take_away)), gone, stage=4)


def _losses() -> Iterator[MishapFault]:
    # If a part suddenly leaves the fingers, the gap jumps: GAP_WRONG.
    gasket = ExpectedDetection(
        errors=(NOTHING_HELD, GAP_WRONG),
        calls=(detect.GASKET_LOST,),
        stages=(detect.PUT_ON_GASKET,),
    )
    pin = replace(detect.NO_PIN, errors=(NOTHING_HELD, GAP_WRONG))
    top = ExpectedDetection(
        errors=(NOTHING_HELD, GAP_WRONG),
        calls=("THE TOP MEETS NOTHING: IT IS LOST",),
        stages=(detect.PUT_ON_TOP,),
    )
    for name, part, told, expected in (
        ("pin.1", "pin0", "aligning pin 1", pin),
        ("pin.2", "pin1", "aligning pin 2", pin),
        ("gasket", "gasket", "the gasket", gasket),
        ("top", "top", "the top", top),
    ):
        meaning = f"The hand lifts {told} by {LIFTED_M / INCH:.1f} in, and then loses {told}."
        yield declared(f"{name}.dropped", meaning, always(Mishap(partial(_lose, part), part)), expected)


def due(faults: Sequence[Fault]) -> list[tuple[Fault, Mishap]]:
    """Return those faults of a run that are mishaps, each with the mishap that it causes."""
    return [(fault, make(fault.value or 0.0)) for fault, make in broken(mishap_faults(), faults)]


class Mishaps(Mechanism[MishapsState]):
    """The mechanism that makes the mishaps of a cell happen while the cell works."""

    name = "mishaps"
    kind = MishapsState
    changes = (
        "light_diffuse", "dof_frictionloss", "dof_solref", "dof_solimp", "jnt_limited", "jnt_range", "jnt_solref",
        "jnt_solimp", "body_pos",
    )  # fmt: skip

    def __init__(self, scene: Scene, faults: Sequence[Fault]) -> None:
        self._scene, self.due = scene, due(faults)
        self._states = [MishapState() for _ in self.due]
        self._begin(lambda stage: stage is None)

    def begin_stage(self, number: int) -> None:
        self._begin(lambda stage: stage is not None and stage <= number)

    def _begin(self, now: Callable[[int | None], bool]) -> None:
        for number, ((fault, mishap), state) in enumerate(zip(self.due, self._states, strict=True)):
            if state.seconds is None and now(fault.stage):
                place = mishap.watched and self._scene.place(mishap.watched).tolist()
                self._states[number] = MishapState(seconds=0.0, place=tuple(place) if place else None)

    def before(self, seconds: float) -> None:
        for number, ((_, mishap), state) in enumerate(zip(self.due, self._states, strict=True)):
            if state.seconds is not None and not state.over:
                over = mishap.act(self._scene, state)
                self._states[number] = MishapState(
                    seconds=state.seconds + seconds, place=state.place, over=over
                )

    def state(self) -> MishapsState:
        return MishapsState(mishaps=tuple(self._states))

    def check(self, state: MishapsState) -> None:
        if len(state.mishaps) != len(self.due):
            raise ValueError("it has different faults")
        for (_, mishap), own in zip(self.due, state.mishaps, strict=True):
            finite(own.place or (), "a fault")
            if not 0 <= (own.seconds or 0.0) < np.inf:
                raise ValueError("a fault has an impossible time")
            if (own.seconds is None or mishap.watched is None) != (own.place is None):
                raise ValueError(
                    "a fault has a place although it must not have one, or has no place although it needs one"
                )

    def restore(self, state: MishapsState) -> None:
        self._states = list(state.mishaps)
