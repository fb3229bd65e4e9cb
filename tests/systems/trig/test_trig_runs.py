"""A taught program goes through what runs are: kept, put back, resumed, stepped back, undone by the arm, traced."""

from collections.abc import Callable
from pathlib import Path

import msgspec
import pytest
from msgspec import UNSET
from trig_bench import low_job, low_script, low_setup

import handeye
from handeye.core.errors import InvalidInput, Refused
from handeye.core.faults import Fault
from handeye.core.variation import Overrides, WorldSpec
from handeye.debugger.ask import Ask
from handeye.debugger.breakpoints import breakpoint
from handeye.debugger.stepper import Stepper
from handeye.execution.servo import Halted
from handeye.execution.state import ReversalOrder
from handeye.judge.finding import all_right
from handeye.program.events import Choice, OperatorCalled, StepFinished, StepStarted
from handeye.results.finishing import outcome
from handeye.results.judging import findings
from handeye.runs.advance import advance
from handeye.runs.checkpoint_file import decode, encode
from handeye.runs.folder import TRACE, RunFolder, open_again, open_new
from handeye.runs.host_seconds import Meter
from handeye.runs.operator import attend
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import system_of
from handeye.runs.undo_orders import to_be_undone
from handeye.runs.verify import difference
from handeye.systems.trig.jobs.benches import JobName, TaughtPlan, open_job
from handeye.systems.trig.language.axes_arm import ArmMemory, AxesArm
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.trig_arm import Resistance
from handeye.systems.trig.run import plan as plans
from handeye.systems.trig.run.job import account, carried_out
from handeye.systems.trig.run.plan import listing
from handeye.systems.trig.run.state import TaughtState
from handeye.trace.plot import plot
from handeye.trace.reading import read_trace
from handeye.trace.tables import tables

pytestmark = pytest.mark.slow


def driven(folder: RunFolder, start: Checkpoint, *, again: bool, steps: int | None = None) -> Runner:
    """A run in a folder, carried out for so many steps, or to its end."""
    runner = Runner(start, observers=lambda runner: [folder.watch(runner, start, again=again)])
    advance(runner, steps=steps)
    return runner


def kept(folder: RunFolder, runner: Runner) -> None:
    """The run is left as it is."""
    folder.checkpoint(runner.checkpoint())
    folder.close()


@pytest.fixture(scope="module")
def whole(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run that was carried out and undone."""
    path, start = tmp_path_factory.mktemp("whole") / "run", low_setup(1, seed=1)
    folder = open_new(path, start)
    runner = driven(folder, start, again=False)
    runner.order_reversal(0, halts=True)
    advance(runner)
    runner.finish()
    folder.close()
    return path


def test_a_run_that_is_taken_up_from_disk_again_and_again_leaves_the_same_bytes(
    tmp_path: Path, whole: Path
) -> None:
    """Before the first step, twice on the way, and while the arm undoes it."""
    folder, start = open_new(tmp_path / "run", low_setup(1, seed=1)), low_setup(1, seed=1)
    kept(folder, Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)]))
    for steps in (4, 8):
        folder, start, faults = open_again(tmp_path / "run")
        assert not faults
        kept(folder, driven(folder, start, again=True, steps=steps))
    folder, start, faults = open_again(tmp_path / "run")
    assert not faults
    runner = driven(folder, start, again=True)
    runner.order_reversal(0, halts=True)
    advance(runner, steps=5)
    kept(folder, runner)
    folder, start, _ = open_again(tmp_path / "run")
    runner = driven(folder, start, again=True)
    runner.finish()
    folder.close()
    assert (tmp_path / "run" / TRACE).read_bytes() == (whole / TRACE).read_bytes()


def test_its_trace_is_verified_by_carrying_it_out_again(tmp_path: Path, whole: Path) -> None:
    trace = read_trace(whole / TRACE)
    assert difference(trace, tmp_path / "again") is None
    assert trace.joints.shape[1] == 6
    pressed = trace.forces(4).force[:, 2]  # BOTTOM, which feels for a block
    assert pressed.max() - pressed.min() > 0.5


def test_a_loop_is_listed_as_it_is_typed_and_told_with_its_round() -> None:
    runner = low_job(3, seed=1)
    assert [step.text for step in runner.listing.steps if step.word == "loop"] == [
        "LOOP GET-BLOCK 2",
        "LOOP GET-BLOCK 4",
    ]
    advance(runner)
    told = [event.text for event in runner.events if isinstance(event, StepStarted) and "LOOP" in event.text]
    assert told == [
        "LOOP GET-BLOCK 2, goes back (1 of 2)",
        "LOOP GET-BLOCK 2, goes back (2 of 2)",
        "LOOP GET-BLOCK 2, goes on",
        "LOOP GET-BLOCK 4, goes back (1 of 4)",
    ]
    assert runner.system.shown["rounds"] == {"16 LOOP GET-BLOCK 2": 0, "19 LOOP GET-BLOCK 4": 1}


def test_its_tables_and_plots_name_units_and_axes(whole: Path) -> None:
    trace = read_trace(whole / TRACE)
    joints, forces, events = (table for table in tables(trace) if table.name != "channels")
    assert [c.unit for c in joints.columns if c.name.endswith("_rate")] == [*3 * ["m/s"], *3 * ["rad/s"]]
    assert forces.about.endswith("; the hand's own axes.")
    assert [panel.unit for panel in plot(trace).panels] == ["deg", "mm", "N", "N"]  # force, and its channel
    said = next(c for c in events.columns if c.name == "said").values
    assert "the hand is at (-0.3, 0.5, 60.2) mm, open 48.0 mm" in said


def test_going_back_in_time_and_forward_again_is_the_same() -> None:
    runner = low_job(1, seed=1)
    advance(runner, steps=9)
    events, state = [*runner.events], encode(runner.checkpoint())
    runner.back_to(3)
    advance(runner, steps=6)
    assert (runner.events, encode(runner.checkpoint())) == (events, state)


def test_the_arm_undoes_some_steps_and_the_program_goes_on_from_there() -> None:
    runner = low_job(1, seed=1)
    stepper = Stepper(runner)
    stepper.do("step 12")
    assert stepper.do("undo 4").error is None
    assert runner.at == 9  # of the twelve steps none was FINISH, which is the fifth
    pause = advance(runner)
    assert (pause.kind, all_right(findings(runner, pause))) == ("end", True)


def test_a_run_of_another_day_is_undone_from_its_checkpoint() -> None:
    runner = low_job(1, seed=1)
    advance(runner)
    undone = Runner(to_be_undone(decode(encode(runner.checkpoint()), "it"), "it"))
    pause = advance(undone)
    assert (pause.kind, undone.undone, all_right(findings(undone, pause))) == ("end", True, True)


def test_what_the_arm_meets_calls_the_operator_and_is_tried_again(monkeypatch: pytest.MonkeyPatch) -> None:
    runner = low_job(0, seed=1)
    advance(runner)
    runner.order_reversal(0, halts=True)
    monkeypatch.setattr(AxesArm, "back", lambda *_: Resistance(force=4.0, limit=3.0))
    assert advance(runner).kind == "operator"
    assert isinstance(runner.events[-1], OperatorCalled)
    assert "the finger met a force of 4.0 N" in runner.events[-1].message
    monkeypatch.undo()
    runner.answer("proceed")
    assert (advance(runner).kind, runner.undone) == ("end", True)


def test_a_step_that_somebody_halts_is_as_if_it_had_not_begun() -> None:
    halt = [False]
    runner = Runner(low_setup(0, seed=1), halt=lambda: halt[0])
    advance(runner, steps=2)
    before = encode(runner.checkpoint())
    halt[0] = True
    with pytest.raises(Halted):
        runner.step()
    runner.rollback()
    assert encode(runner.checkpoint()) == before
    halt[0] = False
    assert advance(runner).kind == "end"
    assert len([event for event in runner.events if isinstance(event, StepFinished)]) == 5


def _far(arm: ArmMemory | None, **changed: object) -> ArmMemory:
    assert arm is not None
    return msgspec.structs.replace(arm, **changed)


@pytest.mark.parametrize(
    "spoil",
    [
        lambda state: msgspec.structs.replace(state, at=999),
        lambda state: msgspec.structs.replace(state, cursor=999),
        lambda state: msgspec.structs.replace(state, positions={}),
        lambda state: msgspec.structs.replace(state, arm=None),
        lambda state: msgspec.structs.replace(state, stage=1),
        lambda state: msgspec.structs.replace(state, undoing=ReversalOrder(left=0, halts=True)),
        lambda state: msgspec.structs.replace(state, arm=_far(state.arm, told=Place(z=1e308))),
        lambda state: msgspec.structs.replace(state, arm=_far(state.arm, opening=1e308)),
    ],
)
def test_a_state_of_another_program_is_refused(spoil: Callable[[TaughtState], TaughtState]) -> None:
    runner = low_job(0, seed=1)
    checkpoint = runner.checkpoint()
    assert checkpoint.snapshot is not None
    state = checkpoint.snapshot.state
    assert isinstance(state, TaughtState)
    forged = msgspec.structs.replace(checkpoint.snapshot, state=spoil(state))
    with pytest.raises(InvalidInput, match="does not fit this program"):
        Runner(msgspec.structs.replace(checkpoint, snapshot=forged))


def test_a_state_of_another_bench_is_refused() -> None:
    one, other = low_job(0, seed=1), low_job(1, seed=1)
    with pytest.raises(InvalidInput, match="not a state of this work cell"):
        other.cell.restore(one.cell.capture())


@pytest.mark.parametrize(
    ("script", "said"),
    [
        ("NOISE", "there is no command `NOISE`"),
        ("M A\nX 10 RECORD\nCN A\nLOOP A 900000000\nRUN", "does not end"),
        ("M A\nX 10 RECORD\nW stolen", "cannot read or write files"),
        ("M A\nX 10 RECORD\nEX stolen", "cannot read or write files"),
        ("R stolen", "cannot read or write files"),
    ],
)
def test_a_plan_that_cannot_be_taught_is_refused(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, script: str, said: str
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InvalidInput, match=said):
        listing(TaughtPlan(job="palletise", script=script))
    assert not [*tmp_path.iterdir()]


def test_the_script_of_a_job_touches_no_file_on_the_bench_either(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InvalidInput, match="cannot read or write files"):
        open_job("bucket", WorldSpec(seed=0), "W stolen").teach(lambda: False)
    assert not [*tmp_path.iterdir()]


def test_worlds_with_what_the_bench_does_not_have_are_refused() -> None:
    setup: Setup = low_setup(0, seed=1).setup
    for world in (
        WorldSpec(seed=1, overrides=Overrides(without=("camera",))),
        WorldSpec(seed=1, faults=(Fault(name="camera.dark"),)),
    ):
        with pytest.raises(InvalidInput, match=r"^(the world has no quantity|there is no fault) `camera"):
            system_of(setup).check(msgspec.structs.replace(setup, world=world))


@pytest.mark.parametrize(
    ("job", "script", "said"),
    [
        ("palletise", "M DONE\nX 10 RECORD", "needs the position PALLET, which"),
        ("bucket", "M CENTER\nX 10 RECORD", "needs 2 blocks, but the script placed 0"),
    ],
)
def test_what_the_script_lacks_of_what_the_referee_looks_for_is_told(
    job: JobName, script: str, said: str
) -> None:
    setup = low_setup(0, seed=1).setup
    plan = TaughtPlan(job=job, script=script)
    runner = Runner(Checkpoint(setup=msgspec.structs.replace(setup, plan=plan)))
    pause = advance(runner)
    with pytest.raises(InvalidInput, match=said):
        findings(runner, pause)


def test_a_plan_on_disk_whose_script_is_wrong_is_refused_by_its_name() -> None:
    plan = plans.encode(TaughtPlan(job="palletise", script="NOISE"))
    with pytest.raises(
        InvalidInput, match=r"^plan\.json is not valid: palletise\.trig, line 1: there is no command"
    ):
        plans.decode(plan, "plan.json")


def test_python_takes_up_only_runs_of_plans(tmp_path: Path) -> None:
    path = tmp_path / "run"
    open_new(path, low_setup(0, seed=1)).close()
    for out in (None, path):
        with pytest.raises(
            InvalidInput,
            match=r"TRIG cannot continue its runs from Python: `handeye resume` continues a run$",
        ):
            handeye.begin(path, out=out)


def test_a_job_that_is_interrupted_is_not_sent_to_commands_of_an_editor() -> None:
    began = [False]
    runner = Runner(low_setup(0, seed=1), halt=lambda: began[0])
    began[0] = True
    report = carried_out(runner)
    assert (report.outcome, report.told) == ("halted", ("0 steps done; interrupted",))


def test_no_step_is_skipped_that_the_arm_undoes(monkeypatch: pytest.MonkeyPatch) -> None:
    runner = low_job(0, seed=1)
    advance(runner)
    monkeypatch.setattr(AxesArm, "back", lambda *_: Resistance(force=4.0, limit=3.0))
    runner.order_reversal(0, halts=True, asked_by="job")
    stepper = Stepper(runner)
    stepper.do("continue")
    events = [*runner.events]
    refused = stepper.do("skip")
    assert refused.error is not None
    assert refused.error.startswith("no step can be skipped while the program runs backwards")
    assert (runner.events, runner.call is not None) == (events, True)
    result = outcome(runner, stepper.pause, Meter(), judged=True)
    assert (result.completed, result.apart, result.exit_code) == (False, UNSET, 1)
    assert account(runner, stepper.pause, result).outcome == "stopped"
    monkeypatch.undo()
    assert stepper.do("proceed").error is None
    assert stepper.do("continue").error is None
    assert outcome(runner, stepper.pause, Meter(), judged=True).apart is True


def test_the_stepper_tells_of_a_taught_program_what_is_true_of_it(monkeypatch: pytest.MonkeyPatch) -> None:
    runner = low_job(0, seed=1)
    stepper = Stepper(runner)
    manual = str(stepper.do("help").said)
    assert all(word not in manual for word in ("set saved", "picture", "inches", "repeat the stage", "AOJ"))
    assert stepper.do("help set").error == "`set` is not a command for runs of TRIG"
    hand, _, grasp = stepper.do("step 3").did[1:]
    assert hand.outcome.startswith("hand at (")
    assert hand.outcome.endswith(") mm")
    assert grasp.outcome == "gap 0.0 mm"
    monkeypatch.setattr(AxesArm, "back", lambda *_: Resistance(force=4.0, limit=3.0))
    called = stepper.do("undo 3")
    assert (
        called.said
        == "the program calls the operator: answer `proceed`, `retry` or `abort`, or use `back` or `undo`"
    )
    said: list[str] = []
    answers = Ask(iter(["s", "a"]), said.append)
    pause = attend(runner, answers)
    assert pause.kind == "operator"
    assert [line[:1] for line in said[0].splitlines()[-6:]] == ["p", "r", "b", "u", "a", "s"]
    assert "is not an answer; type p, r, b, u, a or show" in said[1]


def test_no_breakpoint_waits_for_an_error_that_a_taught_program_never_raises() -> None:
    with pytest.raises(InvalidInput, match=r"^no step of this program raises an error"):
        breakpoint("error:23", listing(TaughtPlan(job="palletise", script=low_script(1))))


@pytest.mark.parametrize(("answer", "at"), [("proceed", 1), ("retry", 1), ("skip", None)])
def test_each_answer_to_a_taught_program_does_what_is_said(
    monkeypatch: pytest.MonkeyPatch, answer: Choice, at: int | None
) -> None:
    runner = low_job(0, seed=1)
    advance(runner, steps=1)
    monkeypatch.setattr(AxesArm, "check_travel", _refused)
    assert advance(runner).kind == "operator"
    assert answer in runner.kind.choices(runner)
    runner.answer(answer)
    assert (runner.at, runner.call) == (at, None)


def test_physics_that_fails_on_the_bench_ends_the_run_and_calls_nobody() -> None:
    runner = low_job(0, seed=1)
    advance(runner, steps=1)
    runner.system.cell.truth.data.qvel[:] = 5000.0
    pause = advance(runner)
    assert (pause.kind == "operator", runner.call) == (False, None)
    assert str(runner.trouble).startswith("the simulated cell broke down (")


def _refused(*_: object) -> None:
    raise Refused("the arm cannot go there")
