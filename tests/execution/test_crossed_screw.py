"""A screw that stands tilted in its hole crosses its thread: it stops high, and the program backs it out.

A pin lies under the far edge of the base, which leans by 3.3 degrees, while the driver holds its screw upright.
"""

from functools import cache
from math import radians

import numpy as np
import pytest
from pump_bench import LAID, Bench, bench, put, shifted, stacked, stage

from handeye.cell.threads import SQUARE, holes_of
from handeye.core.errors import SERVO_LAG, WRONG_TRAVEL
from handeye.core.pose import Pose, planar, pose, rotation_x, translated
from handeye.core.units import INCH
from handeye.program.events import GuardTripped
from handeye.tasks.stanford_cell.dimensions import base_top, screw_holes

pytestmark = pytest.mark.slow

OFF = (0.1, -0.1)
"""How far the stack stands from both blocks (in), so that its far edge can be lifted."""
EDGE = 38.0 + OFF[1] - 2.5
"""Where the base's near edge is, y in W (in): the stack leans about it."""
LEAN = radians(3.25)
"""Of the stack as it is laid; on the pin it comes to rest at 3.28 degrees."""
LYING: Pose = pose(np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]]), (24.2 * INCH, 40.2 * INCH, 3.7e-3))
"""The pin on the table, along x, under the far edge."""


def leaning() -> dict[str, Pose]:
    """The stack with its far edge on one of its pins."""
    about = pose(rotation_x(LEAN)[:3, :3], (0.0, 0.0, 0.0))
    away, back = (0.0, -EDGE * INCH, 0.0), (0.0, EDGE * INCH, 0.0)
    laid = {part: translated(about @ translated(X_WP, away), back) for part, X_WP in stacked(*OFF).items()}
    return {**laid, "pin1": LYING}


def mouth(lay: dict[str, Pose]) -> np.ndarray:
    """Where the first screw's hole is (in), shape (3,), W."""
    return (lay["base"] @ planar(*screw_holes()[0], base_top(), 0.0))[:3, 3] / INCH


@cache
def crossed() -> Bench:
    """The program's own text for the first screw, taught where its hole is; the first try is over."""
    text = stage("drive the first two screws")
    x, y, z = mouth(leaning()) - mouth(stacked())
    positions = {"H0": shifted("H0", x, y, z)}
    first = text[: text.index("        SCREW   S2")]
    return bench(first, positions=positions, lay=leaning(), felt={"LAID": LAID + z}).to("SOJG")


@cache
def tried_again() -> Bench:
    """The experimenter takes the pin away, and the base stands flat with its hole where it was."""
    run = crossed()
    aside = mouth(leaning()) - mouth(stacked())
    for part, X_WP in stacked(*aside[:2]).items():
        put(run.cell, part, X_WP)
    run.run.state.heights["LAID"] = LAID * INCH
    return run.go()


def test_row_60_a_screw_that_stands_tilted_crosses_its_thread() -> None:
    run = crossed()
    upright = run.pose("base")[2, 2]
    assert np.arccos(upright) > SQUARE
    assert (holes_of(run.cell.truth)[0].scarred, run.place("base")[2] > 0.1) == (True, True)


@pytest.mark.row(60)
def test_row_60_a_crossed_thread_ends_by_torque_and_is_told_by_its_depth() -> None:
    run = crossed()
    assert [trip.guard for trip in run.all(GuardTripped)].count("torque") == 1
    assert run.errors[-1] == WRONG_TRAVEL


def test_row_60_a_crossed_screw_is_backed_out_and_goes_home_in_a_scarred_thread() -> None:
    assert holes_of(crossed().cell.truth)[0].screw is None
    run = tried_again()
    thread = holes_of(run.cell.truth)[0]
    assert (run.finished, thread.screw, thread.crossed, thread.scarred) == (True, 0, False, True)
    assert thread.clamp > 40.0


def test_a_screw_that_is_backed_out_lifts_the_hand_and_does_not_push_it_off_its_set_point() -> None:
    """The limit of the depth is wrong, so that the program backs the first screw out, which is home."""
    text = stage("drive the first two screws").replace("TRAVEL  .2 .3", "TRAVEL  .33 .4")
    first = text[: text.index("        SCREW   S2")]
    run = bench(first, lay=stacked(), felt={"LAID": LAID}).to("SOJG")
    assert (WRONG_TRAVEL in run.errors, SERVO_LAG in run.errors) == (True, False)
    assert holes_of(run.cell.truth)[0].clamp < 1e-6
