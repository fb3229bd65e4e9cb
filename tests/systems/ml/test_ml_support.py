"""The rail support: parts, screws and screwdriver in drawn worlds, the reports of the program, and the referee."""

from collections.abc import Callable
from typing import Final

import numpy as np
import pytest
from msgspec.structs import replace

from handeye.cell.threads import ThreadFigures, Threads
from handeye.core.resources import plans
from handeye.core.source import Source, read_source
from handeye.core.variation import WorldSpec
from handeye.results.finishing import finished
from handeye.results.result import Result
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.ml.language.assembler import assembled
from handeye.systems.ml.run.jobs import job_plan, job_setup
from handeye.systems.ml.support.drawing import (
    FRAME,
    NEST,
    PIN_DEPTH,
    PIN_PLACES,
    PINS,
    RAIL_X,
    RAILS,
    ROWS,
    SADDLES,
    mm,
)
from handeye.systems.ml.support.happenings import ScrewReported, reported
from handeye.systems.ml.support.task import SUPPORT
from handeye.tasks.stanford_cell.screws import MM

WORLD: Final = WorldSpec(seed=7)
SYMBOLIC: Final = read_source(plans() / "support.sym").text


def begun(text: str = SYMBOLIC) -> Runner:
    plan = replace(job_plan("support"), text=assembled(Source(text=text, name="support.sym"))[0])
    return Runner(Checkpoint(setup=job_setup(plan, WORLD)))


def changed(*changes: tuple[str, str]) -> str:
    text = SYMBOLIC
    for old, new in changes:
        assert old in text
        text = text.replace(old, new, 1)
    return text


ONE_SCREW: Final = (
    ("START:  LOAD X -4500", "START:  BRANCH FETCH"),
    ("        LOAD HX 4400\n", "        BRANCH RACK\n"),
)
"""The program fetches the screwdriver, drives the first screw, and puts the screwdriver back."""


def put(runner: Runner, name: str, x: float, y: float, z: float) -> None:
    """Put a body somewhere upright (mm, in scene coordinates)."""
    runner.cell.truth.data.joint(name).qpos[:] = (x * MM, y * MM, z * MM, 1, 0, 0, 0)


def lay(runner: Runner) -> None:
    """Put all parts but the screws into their places."""
    nest, high = mm(*NEST), FRAME[2]
    put(runner, "frame", *nest, 0)
    rails = [(side * RAIL_X, 0) for side in (-1, 1)]
    for names, places, z in (
        (RAILS, rails, high),
        (PINS, PIN_PLACES, high - PIN_DEPTH),
        (SADDLES, [(0, y) for y in ROWS], high),
    ):
        for name, place in zip(names, places, strict=True):
            at = mm(*place)
            put(runner, name, nest.x + at.x, nest.y + at.y, z)
    runner.cell.restore(runner.cell.capture())


def done(runner: Runner) -> tuple[Result, list[ScrewReported]]:
    result = finished(runner, advance(runner), Meter(), judged=True)
    return result, [event for event in runner.events if isinstance(event, ScrewReported)]


def wrong(runner: Runner) -> list[str]:
    runner.cell.restore(runner.cell.capture())
    return [name for name, found in SUPPORT.judge(runner.cell.truth).items() if not found.ok]


def threads(runner: Runner) -> Threads:
    (found,) = (part for part in runner.cell.truth.mechanisms if isinstance(part, Threads))
    return found


@pytest.mark.ml_row(50)
@pytest.mark.slow
def test_a_screw_is_driven_judged_by_depth_and_torque_and_the_screwdriver_put_back() -> None:
    runner = begun(changed(*ONE_SCREW))
    lay(runner)
    result, (screw,) = done(runner)
    assert (result.exit_code, result.completed) == (3, True)  # nine screws are missing
    assert screw.found == "seated"
    assert screw.torque > 0.25
    assert abs(screw.deeper) < 1.27 * MM  # a turn
    found = result.referee
    assert found["rack"].ok
    assert found["placed"].ok
    assert threads(runner).holes[0].screw == 0
    assert threads(runner).head_force(0) > 100
    assert 0 < result.figures["fingers_driving_N"] < 20


@pytest.mark.ml_row(50)
@pytest.mark.slow
def test_a_crossed_screw_is_reported_turned_out_and_tried_again() -> None:
    runner = begun(changed(*ONE_SCREW, ("MOST    EQU 9", "MOST    EQU 1")))
    lay(runner)
    held = threads(runner)
    held._figures = ThreadFigures(phases=held._figures.phases, crossing=frozenset({0}))
    result, screws = done(runner)
    assert (result.exit_code, result.message) == (1, "a screw finds no thread (done before: 0)")
    assert [screw.found for screw in screws] == ["crossed"]
    assert screws[0].torque > 0.25
    assert screws[0].deeper < -4 * MM
    assert held.holes[0].screw is None


@pytest.mark.ml_row(50)
@pytest.mark.slow
def test_a_missing_screw_is_reported_by_the_height_of_the_bit() -> None:
    runner = begun(changed(*ONE_SCREW))
    lay(runner)
    put(runner, "screw0", -300, -300, 20)
    result, _ = done(runner)
    assert (result.exit_code, result.message) == (
        1,
        "the bit finds no screw in the dispenser (done before: 0)",
    )


@pytest.mark.ml_row(49)
@pytest.mark.slow
def test_a_part_is_placed_without_search_and_an_empty_place_reported_before_the_hand_leaves() -> None:
    runner = begun(changed(("* THE RAILS\n", "        PRINT 0 &DONE\n        STOP\n")))
    result, _ = done(runner)
    assert result.completed
    nest = mm(*NEST)
    assert np.hypot(*(runner.cell.truth.data.body("frame").xpos[:2] / MM - nest)) < 1
    runner = begun()
    put(runner, "frame", 300, 200, 0)
    result, _ = done(runner)
    assert (result.exit_code, result.message) == (
        1,
        "the hand holds no part, or the wrong part (done before: 0)",
    )
    assert abs(runner.cell.truth.data.joint("x").qpos[0] + 0.1143) < 0.001  # it has not left the pallet


@pytest.mark.slow
def test_the_referee_sees_what_is_out_of_place_and_a_wrong_count() -> None:
    runner = begun()
    missing = ["screws", "screws_depth", "screws_clamp", "counted", "parts"]
    lay(runner)
    assert set(wrong(runner)) == set(missing)
    nest, at = mm(*NEST), mm(0, ROWS[2])
    for name, place, also in (
        ("saddle_3", (nest.x + at.x + 2, nest.y + at.y, FRAME[2]), "placed"),
        ("saddle_3", (nest.x + at.x, nest.y + at.y, FRAME[2] + 0.8), "seated"),
        ("driver", (nest.x, nest.y + 200, 60), "rack"),
    ):
        lay(runner)
        put(runner, name, *place)
        assert set(wrong(runner)) - set(missing) == {also}


def test_reports_of_screws_are_read_from_printed_lines() -> None:
    screw = reported("71 5 -281 308", 3.0)
    assert screw is not None
    assert (screw.screw, screw.found, screw.torque) == (5, "crossed", pytest.approx(0.308))
    assert screw.deeper == pytest.approx(-7.137 * MM, abs=1e-6)
    assert reported("0 22", 3.0) is None
    assert reported("72 3 140", 3.0).found == "lost"  # type: ignore[union-attr]


@pytest.mark.slow
def test_the_commands_of_the_support_take_their_options(command: Callable[..., tuple[int, str, str]]) -> None:
    code, out, _ = command("trials", "support", "--help")
    assert (code, "--seed" in out) == (0, True)
