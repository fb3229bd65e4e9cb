"""A fault is part of what decides a run: it sets in with its stage, is recorded, and comes out again the same."""

from pathlib import Path

import msgspec
import pytest
from short_runs import begin, history, through

from handeye.cell.signal_lines import DefectState, SignalLinesState
from handeye.core.errors import InvalidInput
from handeye.core.faults import Fault
from handeye.program.events import RunStarted
from handeye.runs.advance import advance
from handeye.runs.checkpoint_file import read_checkpoint, write_checkpoint
from handeye.runs.folder import open_new
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.verify import difference
from handeye.trace.reading import read_trace

pytestmark = pytest.mark.slow

OPENING = """
        STAGE   "open"
        OPEN    1
        STAGE   "open on"
        OPEN    1.2
        OPEN    1.4
        STAGE   "open wide"
        OPEN    1.6
"""
STUCK = Fault(name="gap_potentiometer.stuck", stage=2)


def start(*faults: Fault) -> Checkpoint:
    """A run with faults that has not begun."""
    setup = begin(OPENING).setup
    world = msgspec.structs.replace(setup.world, faults=faults)
    return Checkpoint(setup=msgspec.structs.replace(setup, world=world))


def defect(runner: Runner) -> DefectState:
    """The state of the one defect of a run's cell."""
    state = runner.cell.truth.states["lines"]
    assert isinstance(state, SignalLinesState)
    (found,) = state.defects
    return found


def test_a_fault_sets_in_with_the_first_step_of_its_stage() -> None:
    runner = Runner(start(Fault(name="lamp.dead", stage=2)))
    seconds = []
    while not runner.ended:
        runner.step()
        seconds.append(defect(runner).seconds)
    assert [each is not None for each in seconds] == [False, True, True, True]


def test_a_gap_that_does_not_follow_reads_what_it_read_when_the_stage_began() -> None:
    runner = Runner(start(STUCK))
    runner.step()
    before = runner.cell.devices.sense().gap
    through(runner)
    assert runner.cell.devices.sense().gap == pytest.approx(before, abs=0.001)
    assert runner.cell.truth.data.joint("stanford/finger_a").qpos[0] > before / 2 + 0.001


def test_a_run_taken_up_from_a_file_goes_on_with_its_fault(tmp_path: Path) -> None:
    runner = Runner(start(STUCK))
    advance(runner, steps=2)
    write_checkpoint(tmp_path / "a.checkpoint", runner.checkpoint())
    again = Runner(read_checkpoint(tmp_path / "a.checkpoint"))
    assert defect(again) == defect(runner)
    assert history(through(again).events) == history(through(runner).events)


def test_a_run_that_goes_back_to_before_its_fault_has_it_set_in_again() -> None:
    runner = Runner(start(STUCK))
    advance(runner, steps=2)
    then = history(runner.events)
    runner.back_to(1)
    assert defect(runner) == DefectState()
    advance(runner, steps=1)
    assert history(runner.events) == then


def test_a_run_with_a_fault_comes_out_the_same_again(tmp_path: Path) -> None:
    begun = start(STUCK)
    folder = open_new(tmp_path / "run", begun)
    runner = Runner(begun, observers=lambda runner: [folder.watch(runner, begun, again=False)])
    advance(runner)
    runner.finish()
    folder.close()
    assert isinstance(runner.events[0], RunStarted)
    assert runner.events[0].world.faults == (STUCK,)
    assert difference(read_trace(tmp_path / "run" / "trace.mcap"), tmp_path / "again") is None


def test_the_folder_of_a_run_with_another_fault_is_refused(tmp_path: Path) -> None:
    folder = open_new(tmp_path, start(STUCK))
    folder.close()
    with pytest.raises(
        InvalidInput,
        match=r"belongs to another run \(seed 0, gap_potentiometer.stuck from stage 2 on, camera",
    ):
        open_new(tmp_path, start())


@pytest.mark.parametrize(
    ("fault", "sentence"),
    [
        (Fault(name="lamp.daed"), "there is no fault `lamp.daed`; did you mean `lamp.dead`?"),
        (
            Fault(name="lamp.dead", stage=9),
            "the fault `lamp.dead` begins at stage 9, but the program has 3 stages",
        ),
    ],
)
def test_a_fault_that_a_run_cannot_have_is_refused(fault: Fault, sentence: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        Runner(start(fault))
    assert str(refused.value) == sentence
