"""A bench: machines in one scene, under one clock. Their servos run outside the computer."""

import math
from collections.abc import Callable
from fractions import Fraction
from typing import Any, Final

import mujoco
import numpy as np
from msgspec.structs import replace

from handeye.cell.mechanism import Mechanism
from handeye.cell.physics_stepper import asleep, check_physics
from handeye.cell.snapshot_cell import SnapshotCell
from handeye.core.errors import BadArgument, BadFile, HandeyeError, NoSuchName
from handeye.core.record import Record
from handeye.ports.clock import Clock, whole_steps

MICROSECONDS: Final = 1_000_000
_LATEST: Final = 10**15
_MOST_AT_ONCE: Final = 100_000  # events between two physics steps
_FINEST: Final = 10**6
"""If a second has at most this many physics steps, the bench computes with the exact length of a step, as a fraction
of a second (1/960, 1/1200, .001).
"""
FASTEST: Final = 1000.0
"""Greatest plausible speed, in m/s and rad/s. A body on a bench exceeds this speed only if the contact solver fails."""
_STRETCH: Final = Fraction(1, 60)  # longest time (s) for which the action of mechanisms may stay constant


class Due(Record, frozen=True, kw_only=True):
    """A pending event, which is handled between two physics steps."""

    microseconds: int  # when, on the clock of the bench
    name: str  # of its handler


class BenchTime(Record, frozen=True, kw_only=True):
    """The clock of a bench, and its pending events."""

    steps: int  # physics steps since it was switched on
    due: tuple[Due, ...] = ()  # in order


class Bench(Clock, Mechanism[BenchTime]):
    """A scene whose time is counted in whole physics steps, so that machines with different periods stay
    synchronised.

    Machines add themselves to the bench. If the scene allows sleep, bodies at rest are not computed. While all bodies
    sleep, time passes in one jump, and the functions that run at every step are not called.
    """

    name = "clock"
    kind = BenchTime

    def __init__(self, model: mujoco.MjModel) -> None:
        self.model, self.data = model, mujoco.MjData(model)
        self.before_step: list[Callable[[], None]] = []  # called before every physics step
        self.after_step: list[Callable[[], None]] = []
        self.before_period: list[Callable[[], None]] = []
        """Functions called before each advance of the simulated time. An advance lasts at most 1/60 s, except while
        all bodies are asleep.
        """
        self.after_period: list[Callable[[], None]] = []
        self.handlers: dict[str, Callable[[], None]] = {}  # handlers of events, by name
        self._tick = Fraction(model.opt.timestep).limit_denominator(_FINEST)
        self._parts: list[Mechanism[Any]] = []
        self._steps, self._stretch = 0, max(1, int(_STRETCH / self._tick))
        self._due: list[Due] = []
        self._passing = self._ending = False
        mujoco.mj_forward(self.model, self.data)

    def add(self, part: Mechanism[Any]) -> None:
        """Add a mechanism that acts on the scene as time passes. Mechanisms act in the order of the calls of `add`."""
        self._parts.append(part)

    def cell(self, *others: Mechanism[Any]) -> SnapshotCell:
        """Make a cell from this bench and the mechanisms `others`. These other mechanisms do nothing as time passes.
        The scene must not change after this call.
        """
        noise = np.random.Generator(np.random.PCG64(0))
        return SnapshotCell(self.model, self.data, (self, *self._parts, *others), noise)

    def replace(self, spec: mujoco.MjSpec) -> None:
        """Continue with a changed scene. Everything that exists in both the old and the new scene keeps its state."""
        self.model, self.data = spec.recompile(self.model, self.data)
        mujoco.mj_forward(self.model, self.data)
        for part in self._parts:
            part.bind(self.model, self.data)

    # -- time -----------------------------------------------------------------------------------------

    @property
    def tick(self) -> Fraction:
        """The physics step, in s."""
        return self._tick

    @property
    def now(self) -> float:
        return self._steps * self._tick.numerator / self._tick.denominator

    def set_to_zero(self) -> None:
        """Set the clock to 0, because the program begins now. The time until each pending event stays the same."""
        due = [(self._step_of(each) - self._steps) * self.tick * MICROSECONDS for each in self._due]
        self._due = [replace(was, microseconds=int(at)) for was, at in zip(self._due, due, strict=True)]
        self._steps, self.data.time = 0, 0.0

    def advance(self, seconds: float) -> None:
        if self._passing:
            raise BadArgument(
                "time is already advancing on the bench: a hook or an event cannot advance time"
            )
        end = self._steps + whole_steps(seconds, float(self.tick))
        self._passing, self._ending = True, False
        try:
            self._handle_due()
            while self._steps < end and not self._ending:
                self._pass(min(end - self._steps, self._before_event()))
                self._handle_due()
        finally:
            self._passing = False

    def end_early(self) -> None:
        """Let `advance` end with the present physics step. Only a function that runs at every step may call this."""
        self._ending = True

    def call_at(self, microseconds: int, name: str) -> None:
        """Schedule the event `name` for a time (microseconds). The event is handled before the first physics step that
        begins at this time or later.
        """
        if name not in self.handlers:
            raise NoSuchName(f"the bench has no event {name}; its events are {', '.join(self.handlers)}")
        if microseconds >= _LATEST:
            raise BadArgument(
                f"an event at {microseconds / MICROSECONDS:g} s is too late; it must be before "
                f"{_LATEST / MICROSECONDS:g} s"
            )
        self._due.append(Due(microseconds=microseconds, name=name))
        self._due.sort(key=lambda due: due.microseconds)

    @property
    def next_event(self) -> Fraction | None:
        return max(self._before_event(), 1) * self.tick if self._due else None

    def _before_event(self) -> int:
        """Return the number of physics steps before the next event is handled. If no event is pending, return a number
        that is never reached.
        """
        return self._step_of(self._due[0]) - self._steps if self._due else _LATEST

    def _step_of(self, due: Due) -> int:
        """Return the number of the physics step before which an event is handled: the first step that begins at the
        time of the event or later.
        """
        return math.ceil(due.microseconds / (MICROSECONDS * self._tick))

    def _handle_due(self) -> None:
        for _ in range(_MOST_AT_ONCE):
            if self._before_event() > 0:
                return
            self.handlers[(due := self._due.pop(0)).name]()
        raise HandeyeError(
            f"the events at {self.now:g} s cause an endless series of new events, all at this time; the last is "
            f"{due.name}"
        )

    def _pass(self, most: int) -> None:
        """Advance by at most `most` physics steps. If all bodies sleep, skip all these steps. If a body is
        awake, simulate at most `_stretch` steps.
        """
        steps = min(most, self._stretch)
        for part in self._parts:
            part.before(float(steps * self.tick))
        for act in self.before_period:
            act()
        if asleep(self.data):
            most = min(
                most, max(self._before_event(), 1)
            )  # the functions just called may have added an event
            for part in self._parts:
                part.rested(float(max(most - steps, 0) * self.tick))
            self._steps += most
        else:
            self._make(steps)
        self.data.time = self.now
        for part in self._parts:
            part.after()
        for act in self.after_period:
            act()

    def _make(self, steps: int) -> None:
        for _ in range(steps):
            for act in self.before_step:
                act()
            mujoco.mj_step(self.model, self.data)
            self._steps += 1
            for act in self.after_step:
                act()
            if self._ending or self._before_event() <= 0:
                break
        check_physics(self.data.warning.number, self.data.qvel, fastest=FASTEST)

    # -- state ----------------------------------------------------------------------------------------

    def state(self) -> BenchTime:
        return BenchTime(steps=self._steps, due=tuple(self._due))

    def check(self, state: BenchTime) -> None:
        if not 0 <= state.steps < _LATEST or any(due.microseconds >= _LATEST for due in state.due):
            raise BadFile("the saved clock shows an impossible time")
        if not {due.name for due in state.due} <= {*self.handlers}:
            raise BadFile("the saved state contains events that this bench does not have")

    def restore(self, state: BenchTime) -> None:
        self._steps, self._due = state.steps, list(state.due)
