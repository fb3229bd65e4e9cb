"""Programs to step through: one in the air, which needs no parts, and the pin insertion of 1973."""

import msgspec
from pump_bench import INSERT, at_standard, put, settle
from short_runs import begin

from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint

AIR = """\
;A PROGRAM IN THE AIR
        TRANS   T [20 28 7.9 90 90 0]
        STAGE   "open the hand"
        OPEN    .5
        OPEN    .4
        STAGE   "search in the air"
        SEARCH  .07
L1:     MOVE    T               ;OVER THE TABLE
        STOP    [0 0 -50]
        CHANGE  [0 0 -1] .1     ;NOTHING IS THERE
        SKIPE   23
        JUMP    L1
        SAVE    H
L2:     AOJ     L3
L3:     MOVE    T
        RESTORE H
        STAGE   "grasp nothing"
        OPEN    .5
        CLOSE   .4
        OPEN    .4
        STAGE   "shut the hand"
        OPEN    .5
"""
"""Raises error 23 on line 10, which line 11 tests, and error 2 on line 19, which calls the operator."""

PINS = "TRANS T [-1.128 1.226 3.931 -90 90 0] OF PUMP\nOPEN 1\n" + INSERT.replace("P ", "P1", 1)
"""The pin insertion of 1973, with the hole a tenth of an inch off, so that the search reaches its sixth place."""


def before_pins() -> Checkpoint:
    """The beginning of the pin insertion, with the base in its standard position."""
    runner = Runner(begin(PINS))
    for part, X_WP in at_standard().items():
        put(runner.cell, part, X_WP)
    settle(runner.cell)
    begun = runner.checkpoint()
    assert begun.snapshot is not None
    snapshot = msgspec.structs.replace(begun.snapshot, cell=runner.cell.capture())
    return msgspec.structs.replace(begun, snapshot=snapshot)


def reset(runner: Runner) -> Runner:
    """Return the run to its state before the first step."""
    del runner.history[1:]
    runner.rollback()
    runner.observers.clear()
    return runner
