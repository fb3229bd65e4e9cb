"""One screw by the arm itself: fetched from the dispenser, carried by the magnet, driven to a torque stop."""

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from bench_hand import Hand
from finished import stacked

from handeye.cell.threads import holes_of
from handeye.cell.truth import Truth
from handeye.core.pose import Array
from handeye.core.units import INCH
from handeye.tasks.stanford_cell.dimensions import dimensions

DOWN = np.array([0.0, 0.0, -1.0])
STOP = 0.28  # N m
PRESS = 6.0  # N
HOLE = 3


@dataclass(frozen=True, kw_only=True)
class Driven:
    """A screw that has been driven."""

    truth: Truth
    torque: float
    moment: float
    """About the vertical on the hand, by the joint torques, N m."""
    base_moved: float
    """m, sideways."""


def at(truth: Truth, body: str) -> Array:
    return truth.data.xpos[truth.model.body(body).id].copy()


def bring_bit(hand: Hand, truth: Truth, x: float, y: float, z: float) -> None:
    """Carry the driver so that its bit's face gets to a place."""
    tool = truth.data.site_xpos[truth.model.site("stanford/tool").id]
    hand.over(*(np.array([x, y, z]) + tool - at(truth, "bit")))
    hand.zero()


@cache
def driven() -> Driven:
    cell = stacked()
    hand, truth, size = Hand(cell.devices), cell.truth, dimensions()
    length = size("screw.length") + size("screw.head_height")
    hand.over(*size.all("rack.place"), 7.0 * INCH, 90.0)
    hand.fingers(0.0, 80.0)
    hand.load = 0.48 * 9.81  # N, the driver
    screw = at(truth, "screw0")
    bring_bit(hand, truth, screw[0], screw[1], screw[2] + length + 0.01)
    hand.press(DOWN, 0.02, 4.0)
    hole = at(truth, f"carrier{HOLE}")
    bring_bit(hand, truth, hole[0], hole[1], hole[2] + size("top.flange") + length + 0.006)
    hand.press(DOWN, 0.03, 8.0)
    before = at(truth, "base")
    hand.tool = 20.0
    while cell.devices.sense().tool_torque < STOP and truth.data.time < 40.0:
        hand.tick(place=hand.place + DOWN * np.clip((PRESS - hand.force[2]) * 0.0015, -0.01, 0.01) / 60)
    torque, moment = cell.devices.sense().tool_torque, float(hand.force[5])
    hand.tool = 0.0
    hand.rest()
    hand.hold(10)
    moved = float(np.hypot(*(at(truth, "base") - before)[:2]))
    return Driven(truth=cell.truth, torque=torque, moment=moment, base_moved=moved)


@pytest.mark.slow
def test_the_arm_drives_a_screw_home() -> None:
    thread = holes_of(driven().truth)[HOLE]
    assert driven().torque >= STOP
    assert (thread.screw, thread.crossed) == (0, False)
    assert thread.clamp > 50.0


@pytest.mark.slow
def test_the_hand_feels_the_torque_of_the_screw() -> None:
    assert abs(driven().moment) > 0.1


@pytest.mark.slow
def test_driving_a_screw_does_not_move_the_base() -> None:
    assert driven().base_moved < 2e-4
