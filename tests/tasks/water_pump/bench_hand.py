"""A bare hand: straight moves by computed torque, through the ports only."""

import numpy as np
from driving import Drive, tick

from handeye.arm.dynamics import bias, mass_matrix
from handeye.arm.ik import solve
from handeye.arm.kinematics import forward, jacobian
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import Array, hand
from handeye.core.units import DEGREE, INCH, JIFFY
from handeye.ports.workcell import Workcell

STIFFNESS = 25.0  # rad/s, of the servo


class Hand:
    """Points down; moves in straight lines at constant finger direction or turns about its own axis."""

    def __init__(self, cell: Workcell) -> None:
        self.cell = cell
        self.place = np.array([20 * INCH, 28 * INCH, 8 * INCH])
        self.yaw = np.pi / 2
        self.gap, self.grip, self.tool, self.load = 0.05, 20.0, 0.0, 0.0
        self.q = self.solved(cell.sense().q)
        self.before = self.q
        self.force = np.zeros(6)
        self.tare = np.zeros(6)

    def solved(self, near: Array) -> Array:
        """Joint positions of the present set-point."""
        result = solve(STANFORD, hand(*self.place, self.yaw, np.pi / 2, 0.0), near)
        assert result.q is not None, (self.place / INCH, result)
        return result.q

    def tick(self, *, place: Array | None = None, yaw: float | None = None) -> None:
        """One servo period towards a new set-point; estimates the force on the hand."""
        self.place = self.place if place is None else np.asarray(place, float)
        self.yaw = self.yaw if yaw is None else yaw
        sensed = self.cell.sense()
        self.before, self.q = self.q, self.solved(self.q)
        rate = (self.q - self.before) / JIFFY
        M, h = mass_matrix(STANFORD, sensed.q), bias(STANFORD, sensed.q, sensed.qd)
        J = jacobian(STANFORD, sensed.q)
        torque = M @ (2 * STIFFNESS * (rate - sensed.qd) + STIFFNESS**2 * (self.q - sensed.q)) + h
        torque += J.T @ np.array([0, 0, self.load, 0, 0, 0])
        now = tick(self.cell, Drive(torque=torque, gap=self.gap, grip=self.grip, tool=self.tool))
        pushed = M @ (now.qd - sensed.qd) / JIFFY + h - torque
        self.force = np.linalg.solve(J.T, pushed) - self.tare

    def hold(self, ticks: int) -> None:
        """Stay."""
        for _ in range(ticks):
            self.tick()

    def zero(self, ticks: int = 10) -> None:
        """Let the present force count as none."""
        self.tare, found = np.zeros(6), []
        for _ in range(ticks):
            self.tick()
            found.append(self.force)
        self.tare = np.mean(found, axis=0)

    def go(self, x: float, y: float, z: float, seconds: float, degrees: float | None = None) -> None:
        """Straight to a place (m) along a smooth course; `degrees` of the finger line from table x."""
        start, end = self.place, np.array([x, y, z])
        turn0, turn1 = self.yaw, self.yaw if degrees is None else degrees * DEGREE
        steps = round(seconds / JIFFY)
        for i in range(1, steps + 1):
            s = i / steps
            u = 10 * s**3 - 15 * s**4 + 6 * s**5
            self.tick(place=start + u * (end - start), yaw=turn0 + u * (turn1 - turn0))

    def over(self, x: float, y: float, z: float, degrees: float | None = None, height: float = 0.33) -> None:
        """Up, across and down again."""
        self.go(*self.place[:2], height, 1.2)
        self.go(x, y, height, 1.6, degrees)
        self.go(x, y, z, 1.4)

    def press(self, direction: Array, distance: float, stop: float, speed: float = INCH) -> bool:
        """Move until the hand is opposed with more than `stop` (N); whether it was."""
        along = np.asarray(direction, float)
        for i in range(round(distance / speed / JIFFY)):
            self.tick(place=self.place + along * speed * JIFFY * min(1.0, (i + 1) / 6))
            if -self.force[:3] @ along > stop:
                self.rest()
                return True
        return False

    def rest(self) -> None:
        """Freeze the set-point where the arm is, without a reference velocity."""
        self.q = self.cell.sense().q
        self.place = forward(STANFORD, self.q)[:3, 3]
        self.q = self.solved(self.q)

    def fingers(self, gap: float, grip: float = 20.0, ticks: int = 45) -> None:
        """Drive the fingers and wait."""
        self.gap, self.grip = gap, grip
        self.hold(ticks)
