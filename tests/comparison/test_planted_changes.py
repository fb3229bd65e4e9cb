"""Thirty changes are planted, each into a run of its own: the first thing that went otherwise is named rightly."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np
import pytest
from compared_runs import SCRIPT, block_start, kept

from handeye.cell.arm import JointSensors
from handeye.comparison.comparison import Comparison, comparison
from handeye.comparison.first import First
from handeye.comparison.pairing import Place, place_of
from handeye.core.pose import Array
from handeye.program.events import StepStarted
from handeye.report.recorded import RecordedRun

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    return tmp_path_factory.mktemp("planted")


@pytest.fixture(scope="module")
def base(folder: Path) -> RecordedRun:
    """The run without any change."""
    return kept(folder / "base", block_start())


def first_of(found: Comparison) -> First:
    assert found.first is not None
    assert not found.same
    return found.first


# -- one line of the script --------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Edit:
    """A change of the script, and what should be said of it."""

    old: str
    new: str
    quantity: str
    a: str | None
    b: str | None
    line: int


_GUARD = "stops at {} oz along -z, else error 23"
EDITS = [
    Edit("OPEN    2.4", "OPEN    2.3", "statement", "OPEN 2.4", "OPEN 2.3", 3),
    Edit("MOVE    ABOVE", "MOVE    BLOCK", "statement", "MOVE ABOVE", "MOVE BLOCK", 4),
    Edit("[0 0 -16]", "[0 0 -12]", "guard", _GUARD.format(16), _GUARD.format(12), 6),
    Edit("[0 0 -1] .4", "[0 0 -1] .3", "statement", "CHANGE [0 0 -1] .4", "CHANGE [0 0 -1] .3", 6),
    Edit("SKIPN   23", "SKIPE   23", "statement", "SKIPN 23", "SKIPE 23", 7),
    Edit("OPEN    2.5\n", "", "step", "OPEN 2.5", "CLOSE .8", 8),
    Edit("OPEN    2.5\n", "OPEN    2.5\nOPEN 2.6\n", "step", "CLOSE .8", "OPEN 2.6", 10),
    Edit('"grasp"', '"take"', "StageStarted.stage", "grasp", "take", 10),
    Edit("CLOSE   .8", "CLOSE   .9", "statement", "CLOSE .8", "CLOSE .9", 10),
    Edit("[0 0 1] .2", "[0 0 1] .3", "statement", "CHANGE [0 0 1] .2", "CHANGE [0 0 1] .3", 11),
]


@pytest.mark.parametrize("edit", EDITS, ids=lambda edit: f"{edit.old.strip()} to {edit.new.strip()}")
def test_a_changed_line_is_named(folder: Path, base: RecordedRun, edit: Edit) -> None:
    changed = kept(folder / f"edit{EDITS.index(edit)}", block_start(SCRIPT.replace(edit.old, edit.new)))
    found = comparison(base, changed)
    first = first_of(found)
    assert first.place is not None
    named = (first.differing.name, first.differing.a, first.differing.b, first.place.line)
    assert named == (edit.quantity, edit.a, edit.b, edit.line)
    assert "plan" in {condition.what for condition in found.conditions}


# -- one error of the world ----------------------------------------------------------------------------------------

ERRORS = [
    ("block.x", 0.002),
    ("block.x", -1e-5),
    ("block.y", 0.001),
    ("block.thickness", 0.025),
    ("block.thickness", 0.03),
    ("arm.offset.1", 1e-4),
    ("arm.offset.1", -2e-5),
    ("arm.offset.2", 3e-4),
    ("arm.offset.3", 1e-4),
    ("arm.offset.3", -3e-4),
]


def columns(run: RecordedRun) -> dict[str, Array]:
    """Everything that is recorded of each servo period, by its name, shape (n,): what a comparison should go by."""
    trace, names = run.trace, "xyz"
    told = {"gap": trace.gaps}
    for what, values in (("position", trace.joints), ("rate", trace.rates), ("torque", trace.efforts)):
        told |= {f"joint.{name}.{what}": values[:, number] for number, name in enumerate(names)}
    for body, poses in trace.poses.items():
        told |= {f"body.{body}.place.{name}": poses[:, number] for number, name in enumerate(names)}
    return told


@pytest.mark.parametrize(("name", "value"), ERRORS)
def test_an_error_of_the_world_is_named_where_it_first_shows(
    folder: Path, base: RecordedRun, name: str, value: float
) -> None:
    changed = kept(folder / f"{name}{value}", block_start(**{name: value}))
    found = comparison(base, changed)
    assert [condition.what for condition in found.conditions] == [name]
    first, ours, theirs = first_of(found), columns(base), columns(changed)
    others = {each: np.flatnonzero(ours[each][:100] != theirs[each][:100]) for each in ours}
    row = min(rows[0] for rows in others.values() if len(rows))
    named = first.differing.name
    assert named in {each for each, rows in others.items() if len(rows) and rows[0] == row}
    assert (first.differing.a, first.differing.b) == (ours[named][row], theirs[named][row])
    assert (first.place, first.period or 1) == (step_of(base, row), row + 1)


def step_of(run: RecordedRun, row: int) -> Place:
    """The step in whose servo periods a row of the trace is."""
    time = run.trace.times[row]
    begun = [event for event in run.trace.events if isinstance(event, StepStarted) and event.time < time]
    return place_of(run, begun[-1])


def test_two_seeds_of_one_plan_differ_in_where_the_block_stands(folder: Path, base: RecordedRun) -> None:
    other = kept(folder / "seed", block_start(seed=1))
    found = comparison(base, other)
    (condition,) = found.conditions
    assert (condition.what, condition.a, condition.b) == ("seed", "0", "1")
    first = first_of(found)
    assert (first.differing.name, first.differing.unit, first.place) == (
        "body.block.place.x",
        "m",
        step_of(base, 0),
    )
    assert [first.differing.a, first.differing.b] == [run.trace.poses["block"][0, 0] for run in (base, other)]


# -- one bit of the noise ------------------------------------------------------------------------------------------


@dataclass(frozen=True)
class Flip:
    """A reading of a joint in which the last bit is another."""

    row: int
    """The servo period of the run, from 0."""
    joint: int


FLIPS = [Flip(row, joint) for row, joint in zip(range(3, 500, 50), [0, 1, 2] * 3 + [0], strict=True)]


@pytest.mark.parametrize("flip", FLIPS, ids=lambda flip: f"period {flip.row}, joint {flip.joint + 1}")
def test_a_flipped_bit_of_noise_is_named_with_its_servo_period(
    folder: Path, base: RecordedRun, flip: Flip, monkeypatch: pytest.MonkeyPatch
) -> None:
    as_it_was = base.trace.joints[flip.row]
    noisy = as_it_was.copy()
    noisy.view(np.int64)[flip.joint] ^= 1
    read = JointSensors.read

    def read_with_a_flip(sensors: JointSensors, q: Array, qd: Array) -> tuple[Array, Array]:
        positions, rates = read(sensors, q, qd)
        return (noisy.copy() if np.array_equal(positions, as_it_was) else positions), rates

    monkeypatch.setattr(JointSensors, "read", read_with_a_flip)
    found = comparison(base, kept(folder / f"flip{flip.row}", block_start()))
    first, place = first_of(found), step_of(base, flip.row)
    assert found.conditions == ()
    assert first.differing.quantity == ("joint", "xyz"[flip.joint], "position")
    assert (first.differing.a, first.differing.b) == (as_it_was[flip.joint], noisy[flip.joint])
    begun = place.time
    assert (first.place, first.period) == (place, np.sum(base.trace.times[: flip.row + 1] > begun + 1e-4))
