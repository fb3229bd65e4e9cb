"""Screws of the pump turned by a wrench of known torque: what the head then clamps with."""

from collections.abc import Iterator
from functools import cache
from math import hypot, pi

import numpy as np
from driving import tick
from finished import enter, stacked, threads_of
from static_rigs import Force

from handeye.cell.threads import RUNNING_TORQUE, THREAD_FRICTION, THREAD_RADIUS
from handeye.tasks.stanford_cell.dimensions import dimensions

PERIODS, HELD, MEAN = 60, 20, 10
"""Servo periods in which the torque rises, in which it stays, and over which the clamp force is taken."""


def clamp(torque: float, hole: int) -> float:
    """Force (N) of the head of a screw that was turned by a slowly rising torque (N m)."""
    cell = stacked()
    threads, truth = threads_of(cell), cell.truth
    enter(cell, hole, hole, short=0.0)
    dof = truth.model.joint(f"thread_turn{hole}").dofadr[0]
    forces = []
    for period in range(PERIODS + HELD):
        truth.data.qfrc_applied[dof] = -torque * min(1.0, (period + 1) / PERIODS)
        threads.rub(hole)
        tick(cell.devices)
        forces.append(threads.head_force(hole))
    return float(np.mean(forces[-MEAN:]))


@cache
def levers() -> dict[str, float]:
    """What a newton of clamp force takes of torque (m): the pitch, the thread's friction, the head's."""
    size = dimensions()
    model = stacked().truth.model
    slide, twist, _ = model.geom("head0").friction
    return {
        "pitch": size("screw.pitch") / (2 * pi),
        "thread": THREAD_FRICTION * THREAD_RADIUS,
        "head": hypot(slide * size("screw.head_radius"), twist),
        "ring": slide * ring_radius(size("screw.head_radius"), size("top.screw_hole_radius")),
    }


def ring_radius(outer: float, inner: float) -> float:
    """Lever (m) of the friction of a ring that is pressed evenly."""
    return 2 / 3 * (outer**3 - inner**3) / (outer**2 - inner**2)


def screws() -> Iterator[Force]:
    """Clamp forces at two torques, reckoned with the friction that the model's head has."""
    lever = levers()
    for torque, hole in ((0.15, 0), (0.28, 3)):
        reckoned = (torque - RUNNING_TORQUE) / (lever["pitch"] + lever["thread"] + lever["head"])
        yield Force(
            rig=f"a screw turned by {torque} N m",
            what="head",
            reckoned=reckoned,
            simulated=clamp(torque, hole),
        )


def textbook(torque: float) -> float:
    """Clamp force (N) by a torque (N m) if the head rubbed as a plane ring does."""
    lever = levers()
    return (torque - RUNNING_TORQUE) / (lever["pitch"] + lever["thread"] + lever["ring"])
