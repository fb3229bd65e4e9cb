"""A work cell without physics of parts: a perfect arm, scripted contacts, instant ticks."""

from collections.abc import Callable
from dataclasses import dataclass, field

import numpy as np

from handeye.arm.dynamics import inverse_dynamics, mass_matrix
from handeye.arm.kinematics import forward, jacobian
from handeye.arm.robots.stanford import STANFORD
from handeye.ports.camera import COLUMNS, ROWS, Picture, Renderer, TvCamera
from handeye.ports.workcell import Drive, Sensed, Workcell
from handeye.pose import Array
from handeye.units import JIFFY

STIFFNESS = 20e3  # N/m of whatever the hand meets
CRITICAL = 800.0  # N s/m, keeps it from ringing


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


class FakeCamera(TvCamera):
    """Hands out scripted pictures; every mechanical action takes one second."""

    renderer = Renderer(method="none")

    def __init__(self, pictures: list[Picture] | None = None) -> None:
        self.pictures = list(pictures or [])
        self.actions: list[tuple[object, ...]] = []
        self._pots = (0.0, 0.0)

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

    def digitise(self, *, hold_target: bool = False) -> tuple[Picture, float]:
        self.actions.append(("digitise", hold_target))
        picture = self.pictures.pop(0) if self.pictures else np.zeros((ROWS, COLUMNS), np.uint8)
        return picture, 0.5


@dataclass(kw_only=True)
class FakeWorkcell(Workcell):
    """Rigid-body arm without error or noise, starting at rest at `q`.

    `walls` push on the tool centre point; `thickness(p)` is what stands between the fingers when the hand is
    at `p` (m, 0 for nothing); `tool_load` is the torque that the screwdriver meets.
    """

    q: Array
    walls: list[Wall] = field(default_factory=list)
    thickness: Callable[[Array], float] = lambda p: 0.0
    tool_load: float = 0.0
    gap: float = 0.05
    time: float = 0.0
    braked: bool = True
    camera: TvCamera = field(default_factory=FakeCamera)
    drives: list[Drive] = field(default_factory=list)
    """Everything that was put out."""

    def __post_init__(self) -> None:
        self.q = np.array(self.q, dtype=np.float64)
        self.qd = np.zeros(6)
        self.tool = 0.0

    @property
    def tcp(self) -> Array:
        """Where the tool centre point is, m."""
        return np.asarray(forward(STANFORD, self.q)[:3, 3])

    def sense(self) -> Sensed:
        touching = 0.0 < self.thickness(self.tcp) >= self.gap - 1e-9
        return Sensed(
            time=self.time, q=self.q.copy(), qd=self.qd.copy(), gap=self.gap, touch=(touching, touching),
            tool_torque=self.tool_load if self.tool else 0.0, braked=self.braked,
        )  # fmt: skip

    def tick(self, drive: Drive) -> None:
        self.drives.append(drive)
        self.braked, self.tool = drive.brakes, drive.tool
        if drive.brakes:
            self.qd = np.zeros(6)
        else:
            self._move(drive.torque)
        step = STANFORD.hand.gap_speed * JIFFY
        self.gap = max(self.gap + min(max(drive.gap - self.gap, -step), step), self.thickness(self.tcp))
        self.time += JIFFY

    def late(self) -> None:
        self.braked, self.tool = True, 0.0
        self.qd = np.zeros(6)
        self.time += JIFFY

    def _move(self, torque: Array, steps: int = 16) -> None:
        """Semi-implicit steps under a held torque; the arm's matrices are taken once per tick."""
        M = mass_matrix(STANFORD, self.q)
        bias = inverse_dynamics(STANFORD, self.q, self.qd, np.zeros(6))
        J, X = jacobian(STANFORD, self.q), self.tcp
        q0, damping = self.q.copy(), np.array([joint.damping for joint in STANFORD.joints])
        for _ in range(steps):
            p, v = X + (J @ (self.q - q0))[:3], (J @ self.qd)[:3]
            push = sum((wall.force(p, v) for wall in self.walls), np.zeros(3))
            tau = torque - bias - damping * self.qd + J[:3].T @ push
            self.qd = self.qd + np.linalg.solve(M, tau) * JIFFY / steps
            self.q = self.q + self.qd * JIFFY / steps
