"""A second system goes through everything that runs are: stepped, broken at, put back, kept, answered, traced."""

from pathlib import Path

import msgspec
import pytest
from short_runs import begin, history
from toy_system import CounterMachine, Lines, Registers, ToySystem, begin_toy, encoded

from handeye.core import entries
from handeye.core.errors import BadArgument, InvalidInput
from handeye.debugger.breakpoints import breakpoint
from handeye.debugger.formatting import as_text
from handeye.debugger.stepper import Stepper
from handeye.program.events import RunStarted
from handeye.results.pauses import pause_sentence
from handeye.results.summary import summary
from handeye.runs.advance import advance
from handeye.runs.checkpoint_file import decode, encode, read_checkpoint
from handeye.runs.folder import TRACE, open_again, open_new
from handeye.runs.host_seconds import HostSeconds
from handeye.runs.operator import Abort, Retry, attend
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.runs.verify import difference
from handeye.trace.account import account
from handeye.trace.reading import read_trace


def values(runner: Runner) -> dict[str, int]:
    assert isinstance(runner.system.state, Registers)
    return runner.system.state.values


def answered(runner: Runner) -> Runner:
    """The run, gone on with after its call to the operator, to its end."""
    advance(runner)
    runner.answer("proceed")
    advance(runner)
    runner.finish()
    return runner


def traced(start: Checkpoint, folder: Path) -> Path:
    """The trace of a whole run."""
    keeping = open_new(folder, start)
    answered(Runner(start, observers=lambda runner: [keeping.watch(runner, start, again=False)]))
    keeping.close()
    return folder / TRACE


def test_it_is_stepped_to_its_end() -> None:
    runner = answered(Runner(begin_toy()))
    assert (values(runner), runner.position, runner.time) == ({"A": 0, "B": 15}, 18, 18.0)


def test_a_plan_is_written_once_for_all_checkpoints_of_its_run(monkeypatch: pytest.MonkeyPatch) -> None:
    plans: list[Lines] = []

    def counted(plan: Lines) -> bytes:
        plans.append(plan)
        return encoded(plan)

    monkeypatch.setattr(ToySystem, "encode", lambda _, plan: counted(plan))
    start, other = begin_toy(), begin_toy()
    for checkpoint in (start, start, other):
        encode(checkpoint)
    assert plans == [start.setup.plan, other.setup.plan]


def test_it_is_broken_at_a_line_a_label_and_a_stage() -> None:
    runner = Runner(begin_toy())
    stops = [breakpoint(text, runner.listing) for text in ("AGAIN", "4", "ask")]
    told = [pause_sentence(advance(runner, [stop])) for stop in stops]
    assert told == ["breakpoint at label AGAIN", "breakpoint at line 4", "breakpoint at stage 2, ask"]


def test_what_there_is_to_show_of_it_is_told_by_its_own_topics() -> None:
    told = Stepper(Runner(begin_toy())).do("show joints")
    assert told.error == "there is no `joints` to show; the topics are time, state"


def test_it_is_put_back_in_time_and_goes_the_same_way_again() -> None:
    runner = Runner(begin_toy())
    advance(runner)
    once = history(runner.events)
    runner.back_to(3)
    assert values(runner) == {"A": 4, "B": 1}
    advance(runner)
    assert history(runner.events) == once


def test_a_checkpoint_on_disk_goes_on_to_the_same_bytes() -> None:
    runner, unbroken = Runner(begin_toy()), answered(Runner(begin_toy()))
    for _ in range(7):
        runner.step()
    resumed = answered(Runner(decode(encode(runner.checkpoint()), "it")))
    assert history(resumed.events) == history(unbroken.events)
    assert encode(resumed.checkpoint()) == encode(unbroken.checkpoint())


def test_a_state_of_another_system_is_refused() -> None:
    toy, program = Runner(begin_toy()), Runner(begin())
    with pytest.raises(InvalidInput, match="does not fit this plan"):
        toy.system.restore(program.system.state)
    with pytest.raises(InvalidInput, match="belongs to another system"):
        program.system.restore(toy.system.state)


def test_a_state_that_points_outside_its_plan_is_refused() -> None:
    runner = Runner(begin_toy())
    kept = runner.checkpoint()
    setup = msgspec.structs.replace(kept.setup, plan=begin_toy(2).setup.plan)
    assert kept.snapshot is not None
    state = msgspec.structs.replace(kept.snapshot.state, at=99)
    hostile = msgspec.structs.replace(
        kept, setup=setup, snapshot=msgspec.structs.replace(kept.snapshot, state=state)
    )
    with pytest.raises(InvalidInput, match="does not fit this plan"):
        Runner(hostile)


def test_an_unknown_system_is_refused_in_a_sentence(monkeypatch: pytest.MonkeyPatch) -> None:
    data = encode(Runner(begin_toy()).checkpoint())
    monkeypatch.setattr(entries, "_registered", {})
    with pytest.raises(
        InvalidInput,
        match=r"^there is no system `toy` here; the systems are program, trig, sigma, ml, relay$",
    ):
        decode(data, "it")


def test_policies_answer_its_operator() -> None:
    runner = Runner(begin_toy())
    assert attend(runner, Abort()).message == "the operator is wanted"
    again = Runner(begin_toy(1))
    attend(again, Retry(2))
    assert values(again) == {"A": 0, "B": 3}


def test_its_trace_tells_what_happened_and_verifies(tmp_path: Path) -> None:
    trace = read_trace(traced(begin_toy(1), tmp_path / "run"))
    assert [line.strip() for line in account(trace.events)][:5] == [
        "toy: 6 steps",
        f"plan {trace.head.plan}; "
        + ", ".join(f"{name} {version}" for name, version in trace.head.versions.items()),
        "",
        "COUNT: done in 4.0 s",
        "0.00     1  ADD A 1",
    ]
    assert difference(trace, tmp_path / "again") is None


def test_a_run_that_was_broken_off_is_gone_on_with_from_its_folder_to_the_same_trace(tmp_path: Path) -> None:
    whole = traced(begin_toy(), tmp_path / "whole").read_bytes()
    start = begin_toy()
    keeping = open_new(tmp_path / "run", start)
    runner = Runner(start, observers=lambda runner: [keeping.watch(runner, start, again=False)])
    advance(runner, steps=9)
    keeping.close()
    folder, kept, _ = open_again(tmp_path / "run")
    answered(Runner(kept, observers=lambda runner: [folder.watch(runner, kept, again=True)]))
    folder.close()
    assert (tmp_path / "run" / TRACE).read_bytes() == whole


def test_the_stepper_works_on_it(tmp_path: Path) -> None:
    stepper = Stepper(Runner(begin_toy()))
    told = [as_text(stepper.do(line)) for line in ("step 2", "set register B 7", "show", "back", "stage")]
    assert "ADD B 1" in told[0]
    assert "experiment: register B is set to 7" in told[1]
    assert "values {'A': 5, 'B': 7}" in told[2]
    assert "1 step undone" in told[3]
    assert "stage 1, count, has ended" in told[4]


def test_checkpoints_are_found_by_stage(tmp_path: Path) -> None:
    start = begin_toy(2)
    traced(start, tmp_path / "run")
    folder, newest, _ = open_again(tmp_path / "run")
    found = folder.kept.for_stage(start.setup, 1)
    assert found is not None
    assert (found.stage, found.position, read_checkpoint(next(folder.kept.heads())[0])) == ("ask", 7, newest)


def test_time_counts_from_the_beginning_of_the_run() -> None:
    runner = Runner(begin_toy())
    advance(runner, steps=2)
    stepper = Stepper(runner)
    assert (runner.events[0].time, runner.time) == (0.0, 2.0)
    assert as_text(stepper.standing()).splitlines()[0].endswith("2 steps done, 2.00 s")
    assert as_text(stepper.do("show time")).splitlines()[-1].split() == ["time", "2.00", "s"]


def test_a_system_that_begins_a_run_at_another_time_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    began = CounterMachine.begin

    def late(self: CounterMachine) -> list[RunStarted]:
        return [msgspec.structs.replace(begun, time=3.0) for begun in began(self)]

    monkeypatch.setattr(CounterMachine, "begin", late)
    with pytest.raises(BadArgument, match=r"^the system toy begins a run at 3 s; a run must begin at 0 s$"):
        Runner(begin_toy())


def test_a_system_that_moves_nothing_lacks_no_motions_in_its_trace(tmp_path: Path) -> None:
    trace = read_trace(traced(begin_toy(), tmp_path / "run"))
    assert (trace.events[-1].time, trace.begins) == (18.0, 0.0)


def test_its_result_has_stages_and_no_camera() -> None:
    runner = answered(Runner(begin_toy()))
    result = summary(runner, advance(runner), findings=None, built={}, host=HostSeconds(run_wall_s=1.0))
    assert [(stage.name, stage.status) for stage in result.stages] == [("count", "done"), ("ask", "done")]
    assert (result.completed, result.camera.renderer) == (True, "none")
