"""The exercise of docs/language/seventh-screw.md: by script and one taught position, as it stands there."""

import re
from pathlib import Path

import pytest
from conftest import Command
from whole_runs import STAGES, Whole, whole_run

from handeye.al import compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.cell.threads import holes_of
from handeye.core.resources import plans
from handeye.core.source import Source
from handeye.core.units import DEGREE, INCH
from handeye.core.variation import Overrides, WorldSpec
from handeye.core.world_options import by_number, faults
from handeye.planfile.plan import Plan
from handeye.planfile.store import read_plan
from handeye.planning.planner import make_plan
from handeye.program.events import PartMatched
from handeye.program.program import Position
from handeye.program.taught import load_taught
from handeye.runs.advance import advance
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.tasks import task
from handeye.trials.sound_run import with_faults

pytestmark = pytest.mark.slow

DOC = (Path(__file__).parents[2] / "docs/language/seventh-screw.md").read_text(encoding="utf-8")
LESSON = re.findall(r"^teach> (.*)$", DOC, re.MULTILINE)
(WHERE,) = re.findall(r"^ +TRANS +S7 .*\n", DOC, re.MULTILINE)
(SCREW,) = re.findall(r"^ +SCREW +S7 .*\n", DOC, re.MULTILINE)
(SETTING,) = (words.split() for words in re.findall(r"^\$ handeye teach seven.al (.*)$", DOC, re.MULTILINE))
PUMP = (plans() / "water_pump.al").read_text(encoding="utf-8")
BEHIND = PUMP.rindex("        RACK")


def edited() -> str:
    """The script with what the exercise adds."""
    head = PUMP.index('        STAGE   "find the base"')
    return PUMP[:head] + WHERE + PUMP[head:BEHIND] + SCREW + PUMP[BEHIND:]


@pytest.fixture(scope="module")
def hole() -> Position:
    """The position that the exercise shows the teacher to have written."""
    (figures,) = re.findall(r"^H6 is \[(.*)\] of PUMP$", DOC, re.MULTILINE)
    x, y, z, o, a, t = map(float, figures.split())
    return Position(at=(x * INCH, y * INCH, z * INCH, o * DEGREE, a * DEGREE, t * DEGREE), of="PUMP")


def planned(text: str, hole: Position) -> Plan:
    taught = load_taught(plans() / "water_pump.toml")
    taught.positions["H6"] = hole
    program, diagnostics = compile_text(Source(name="seven.al", text=text), taught)
    assert program is not None, diagnostics
    plan, problems = make_plan(program, STANFORD, task="water_pump")
    assert plan is not None, problems
    return plan


def test_the_lesson_teaches_the_position_that_the_exercise_shows(command: Command, hole: Position) -> None:
    Path("seven.toml").write_text((plans() / "water_pump.toml").read_text(encoding="utf-8"))
    code, _, _ = command("teach", "seven.al", *SETTING, typed="\n".join(LESSON) + "\n")
    assert code == 0
    taught = load_taught("seven.toml").positions["H6"]
    assert taught.of == "PUMP"
    assert taught.at == pytest.approx(hole.at, abs=0.002 * INCH)


def test_the_script_makes_a_plan_that_differs_by_one_screw(hole: Position) -> None:
    before, after = read_plan(plans() / "water_pump.plan.json"), planned(edited(), hole)
    assert set(after.program.positions) - set(before.program.positions) == {"H6", "S7"}
    texts, more = ([step.text for step in plan.program.steps] for plan in (before, after))
    fetched = next(number for number, text in enumerate(more) if text.split()[-1] == "S7")
    start = max(number for number, text in enumerate(more[:fetched]) if text == "ASSIGN  TAKEN 2")
    added = len(more) - len(texts)
    assert more[:start] + more[start + added :] == texts


@pytest.fixture(scope="module")
def whole(hole: Position) -> Whole:
    """The pump of the later make, assembled by the program with what the exercise adds to it."""
    return whole_run(
        planned(edited(), hole), WorldSpec(seed=0, overrides=Overrides(set={"pump.screws": 7.0}))
    )


@pytest.mark.row(57, drawn=1)
def test_the_seventh_screw_goes_home_in_the_pump_that_the_program_has_assembled(whole: Whole) -> None:
    threads = holes_of(whole.runner.cell.truth)
    assert (threads[6].screw, sorted(thread.screw for thread in threads)) == (6, list(range(7)))
    assert not any(thread.crossed for thread in threads)
    assert min(thread.clamp for thread in threads) > 40
    assert whole.result.exit_code == 0


@pytest.mark.row(55, drawn=1)
def test_row_55_the_eleven_stages_are_done_in_order_and_five_screws_in_one(whole: Whole) -> None:
    assert whole.started() == whole.done() == STAGES
    assert [whole.torques(f"drive the {which} screws") for which in ("first two", "last four")] == [2, 5]


@pytest.mark.row(58, drawn=1)
def test_row_58_the_times_of_another_run_add_up(whole: Whole) -> None:
    result, timing = whole.result, whole.result.timing
    assert sum(stage.arm_s for stage in result.stages) == pytest.approx(timing.manipulation_s, abs=0.1)
    assert timing.working_s == pytest.approx(timing.manipulation_s + whole.lens(), abs=0.01)
    assert timing.vision_cpu_s < 0.02 * timing.working_s


@pytest.fixture(scope="module")
def parked(whole: Whole) -> Checkpoint:
    """The state in which the arm has parked, and only the last picture is to come."""
    steps = whole.runner.listing.steps
    (before,) = (
        state
        for state in whole.runner.history
        if state.state.at is not None and steps[state.state.at].text.startswith("LOOK    DONE")
    )
    return whole.runner.checkpoint(before)


@pytest.mark.parametrize("fault", ["base.removed", "base.moved.x=0.5in", "base.moved.y=-0.812in"])
def test_a_pump_that_somebody_moves_behind_the_last_touch_is_not_done(parked: Checkpoint, fault: str) -> None:
    """What chaos found: the pump moves in the half second before the last picture."""
    given = faults(task().faults(parked.setup.world), [f"{fault}@{len(STAGES)}"], by_number)
    moved = Runner(with_faults(parked, given))
    paused = advance(moved)
    matches = [event.ok for event in moved.events if isinstance(event, PartMatched)]
    assert (paused.kind, matches) == ("operator", [False])
