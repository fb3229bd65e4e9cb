"""Fake devices of a few lines each, under one clock: a perfect arm, and scripted contacts instead of physics."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from typing import Protocol

import numpy as np

from handeye.arm.dynamics import bias, mass_matrix
from handeye.arm.kinematics import forward, jacobian
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import Array
from handeye.ports.axes import Axes, AxesReading, AxisSpec
from handeye.ports.camera import COLUMNS, ROWS, Picture, Renderer, TvCamera
from handeye.ports.clock import Clock, whole_steps
from handeye.ports.workcell import (
    ArmPort,
    ArmReading,
    HandPort,
    HandReading,
    LampPort,
    ScrewdriverPort,
    Workcell,
)

STEP = 1 / 960  # s, of the fake clock
STIFFNESS = 20e3  # N/m of whatever the hand meets
CRITICAL = 800.0  # N s/m, keeps it from ringing


Mechanics = Callable[[Array, Array], tuple[Array, Array]]
"""Mass matrix of the Stanford arm, and torques that keep it moving without friction, from q and its rates."""


def by_formulas(q: Array, qd: Array) -> tuple[Array, Array]:
    """The mechanics by the formulas; `compiled_mechanics.py` has them in C."""
    damping = np.array([joint.damping for joint in STANFORD.joints])
    return mass_matrix(STANFORD, q), bias(STANFORD, q, qd) - damping * qd


class Device(Protocol):
    """A device for which time passes."""

    def elapse(self, seconds: float) -> None: ...


class FakeClock(Clock):
    """A clock whose time passes at once."""

    now = 0.0

    def __init__(self, *devices: Device) -> None:
        self.devices = devices

    def advance(self, seconds: float) -> None:
        whole_steps(seconds, STEP)
        for device in self.devices:
            device.elapse(seconds)
        self.now += seconds


@dataclass(frozen=True, kw_only=True)
class Wall:
    """Everything with (p - point) . normal < 0 is solid for the tool centre point."""

    point: tuple[float, float, float]
    normal: tuple[float, float, float] = (0.0, 0.0, 1.0)

    def force(self, p: Array, v: Array) -> Array:
        """Force on the hand at `p` that moves with `v`, N."""
        n = np.array(self.normal)
        depth = -float((p - np.array(self.point)) @ n)
        return n * max(0.0, STIFFNESS * depth - CRITICAL * float(v @ n)) if depth > 0 else 0.0 * n


class FakeArm(ArmPort):
    """Rigid bodies without error or noise, at rest at `q` first; `push` (N) and walls act on the tool centre point."""

    def __init__(self, q: Array, mechanics: Mechanics = by_formulas) -> None:
        self.q, self.qd, self.mechanics = np.array(q, dtype=np.float64), np.zeros(len(q)), mechanics
        self.walls: list[Wall] = []
        self.push = np.zeros(3)
        self.braked, self.cut, self.torque, self.unanswered = True, False, None, 0.0

    @property
    def tcp(self) -> Array:
        """Position of the tool centre point, m."""
        return np.asarray(forward(STANFORD, self.q)[:3, 3])

    def read(self) -> ArmReading:
        return ArmReading(q=self.q.copy(), qd=self.qd.copy(), braked=self.braked)

    def drive(self, torque: Array | None) -> None:
        self.torque, self.unanswered = torque, 0.0
        self.cut = self.cut and torque is not None

    def elapse(self, seconds: float) -> None:
        self.unanswered += 0.0 if self.torque is None else seconds
        self.cut = self.cut or self.unanswered > STANFORD.servo.period * (1 + 1e-6)
        self.braked = self.cut or self.torque is None
        if self.braked:
            self.qd = np.zeros(len(self.q))
        else:
            self._move(self.torque, seconds)

    def _move(self, torque: Array, seconds: float, steps: int = 16) -> None:
        """Semi-implicit steps under a held torque; the arm's matrices are taken once for all of them."""
        M, frictionless = self.mechanics(self.q, self.qd)
        inverse = np.linalg.inv(M)
        pushed = self._pushes() if self.walls or self.push.any() else (lambda q, qd: 0.0)
        damping, step = np.array([joint.damping for joint in STANFORD.joints]), seconds / steps
        for _ in range(steps):
            tau = torque - frictionless - damping * self.qd + pushed(self.q, self.qd)
            self.qd = self.qd + inverse @ tau * step
            self.q = self.q + self.qd * step

    def _pushes(self) -> Callable[[Array, Array], Array]:
        """Torques by which the walls push, from q and its rates, near the present q."""
        J, X, q0 = jacobian(STANFORD, self.q)[:3], self.tcp, self.q

        def pushed(q: Array, qd: Array) -> Array:
            p, v = X + J @ (q - q0), J @ qd
            return np.asarray(J.T @ sum((wall.force(p, v) for wall in self.walls), self.push))

        return pushed


def nothing(p: Array) -> float:
    """Return the thickness (m) if no object is there: 0."""
    return 0.0


class FakeHand(HandPort):
    """Fingers that close on the object between them. `thickness` gives the thickness of the object at the place of the
    hand (m); 0 if there is none.
    """

    def __init__(self, arm: FakeArm, gap: float = 0.05) -> None:
        self.arm, self.gap, self.goal, self.grip = arm, gap, gap, 0.0
        self.thickness: Callable[[Array], float] = nothing

    def read(self) -> HandReading:
        touching = 0.0 < self._between() >= self.gap - 1e-9
        return HandReading(gap=self.gap, touch=(touching, touching))

    def drive(self, gap: float, grip: float) -> None:
        self.goal, self.grip = gap, grip

    def elapse(self, seconds: float) -> None:
        step = STANFORD.hand.gap_speed * seconds
        moved = self.gap + min(max(self.goal - self.gap, -step), step)
        self.gap = max(moved, self._between())

    def _between(self) -> float:
        """Thickness (m) of the object at the place of the hand."""
        return 0.0 if self.thickness is nothing else self.thickness(self.arm.tcp)


@dataclass
class FakeScrewdriver(ScrewdriverPort):
    """A motor with the same load as long as it turns."""

    load: float = 0.0
    speed: float = 0.0
    magnet: bool = True

    def torque(self) -> float:
        return self.load if self.speed else 0.0

    def drive(self, speed: float) -> None:
        self.speed = speed

    def attract(self, on: bool) -> None:
        self.magnet = on


@dataclass
class FakeLamp(LampPort):
    """A lamp in the dark."""

    lit: bool = False

    def switch(self, lit: bool) -> None:
        self.lit = lit


class FakeCamera(TvCamera):
    """Hands out scripted pictures, then noise; every mechanical action takes one second."""

    renderer = Renderer(method="none")

    def __init__(self, pictures: Sequence[Picture] = ()) -> None:
        self.pictures = list(pictures)
        self.actions: list[tuple[object, ...]] = []
        self._pots = (0.0, 0.0)
        self._noise = np.random.default_rng(0)

    def lens(self, focal_length: float) -> float:
        self.actions.append(("lens", focal_length))
        return 1.0

    def aim(self, pan: float, tilt: float) -> float:
        self.actions.append(("aim", pan, tilt))
        self._pots = (pan, tilt)
        return 1.0

    def focus(self, distance: float) -> float:
        self.actions.append(("focus", distance))
        return 1.0

    def pots(self) -> tuple[float, float]:
        return self._pots

    def digitise(self, *, hold_target: bool = False) -> Picture:
        self.actions.append(("digitise", hold_target))
        if self.pictures:
            return self.pictures.pop(0)
        return self._noise.integers(0, 2, (ROWS, COLUMNS), np.uint8)


class FakeAxes(Axes):
    """Axes that move to their goals at their greatest speed."""

    specs: tuple[AxisSpec, ...] = ()
    period, name = 1 / 100, "fake"

    def __init__(self, clock: FakeClock, *specs: AxisSpec) -> None:
        self.clock, self.specs = clock, specs
        self.q = self.goal = np.zeros(len(specs))
        self.felt: dict[str, float] = {}
        clock.devices = (*clock.devices, self)

    def read(self) -> AxesReading:
        return AxesReading(time=self.clock.now, q=self.q.copy(), channels=dict(self.felt))

    def put(self, goal: Array) -> None:
        self.goal = np.clip(goal, [s.lower for s in self.specs], [s.upper for s in self.specs])

    def elapse(self, seconds: float) -> None:
        reach = np.array([spec.speed for spec in self.specs]) * seconds
        self.q = self.q + np.clip(self.goal - self.q, -reach, reach)


class FakeCell:
    """One fake device of each kind, and the cell that they make."""

    def __init__(self, q: Array, mechanics: Mechanics = by_formulas) -> None:
        self.arm = FakeArm(q, mechanics)
        self.hand = FakeHand(self.arm)
        self.screwdriver, self.lamp, self.camera = FakeScrewdriver(), FakeLamp(), FakeCamera()
        self.clock = FakeClock(self.arm, self.hand)
        self.devices = Workcell(
            clock=self.clock, arm=self.arm, hand=self.hand, screwdriver=self.screwdriver,
            lamp=self.lamp, camera=self.camera,
        )  # fmt: skip
