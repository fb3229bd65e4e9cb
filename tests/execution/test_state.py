"""The state of a working phase is one record, and nothing is remembered beside it."""

import dataclasses

import numpy as np
from fakes import FakeCell

from handeye.arm.robots.stanford import STANFORD
from handeye.execution.context import ExecutionContext
from handeye.execution.drive import ArmDrive
from handeye.execution.executor import Executor
from handeye.execution.state import DriveState
from handeye.program.world_model import WorldModel

GIVEN = {
    Executor: {"run"},
    ExecutionContext: {
        "plan",
        "arm",
        "cell",
        "camera",
        "emit",
        "search",
        "seeing",
        "arithmetic",
        "vision",
        "drive",
        "world",
        "without",
    },
    ArmDrive: {"cell", "arm", "arithmetic", "_chain", "_unseen", "watch", "halt", "track"},
    WorldModel: {"parts", "positions"},
}
"""Given anew to each when a run is taken up; `vision` counts processor time, which differs from run to run, `track`
is begun anew with each step, `_unseen` with each servo period, and `_chain` is made of what is given and what the arm
has weighed."""


def test_what_works_holds_what_it_is_given_and_its_state() -> None:
    held = {owner: {field.name for field in dataclasses.fields(owner)} for owner in GIVEN}
    assert {owner: held[owner] - GIVEN[owner] for owner in GIVEN} == {
        Executor: set(),
        ExecutionContext: {"state"},
        ArmDrive: {"state"},
        WorldModel: {"state"},
    }


def test_an_arm_that_is_held_anew_forgets_what_it_felt_and_not_what_it_has_measured_of_itself() -> None:
    sensed = FakeCell(np.zeros(6)).devices.sense()
    drive = DriveState.holding(sensed, STANFORD)
    drive.friction, drive.links = np.arange(6.0), np.arange(6.0) + 1
    drive.wrench, drive.q, drive.cut, drive.in_air = np.ones(6), np.ones(6), True, True
    drive.hold_anew(sensed, STANFORD)
    assert (drive.friction.tolist(), drive.links.tolist()) == ([*range(6)], [*range(1, 7)])
    assert [drive.wrench.any(), drive.q.any(), drive.cut, drive.in_air] == [False] * 4
