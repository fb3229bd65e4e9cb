"""The state of a working phase is one record, and nothing is remembered beside it."""

import dataclasses

from handeye.execution.context import ExecutionContext
from handeye.execution.drive import ArmDrive
from handeye.execution.executor import Executor
from handeye.program.world_model import WorldModel

GIVEN = {
    Executor: {"run"},
    ExecutionContext: {"plan", "arm", "cell", "camera", "emit", "search", "vision", "drive", "world"},
    ArmDrive: {"cell", "arm", "watch", "halt"},
    WorldModel: {"parts", "positions"},
}
"""Given anew to each when a run is taken up; `vision` counts processor time, which differs from run to run."""


def test_what_works_holds_what_it_is_given_and_its_state() -> None:
    held = {owner: {field.name for field in dataclasses.fields(owner)} for owner in GIVEN}
    assert {owner: held[owner] - GIVEN[owner] for owner in GIVEN} == {
        Executor: set(),
        ExecutionContext: {"state"},
        ArmDrive: {"state"},
        WorldModel: {"state"},
    }
