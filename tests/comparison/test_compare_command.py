"""`handeye compare`: what it says of two recorded runs, and one sentence on what cannot be compared."""

import json
from dataclasses import replace
from pathlib import Path
from typing import Any

import msgspec
import pytest
from compared_runs import block_start, kept
from conftest import Command
from recordings import EVENTS, Recording, record
from report_pages import changed, recorded
from told_runs import saved, told
from toy_system import TOY

from handeye.comparison.comparison import Comparison, Condition, comparison
from handeye.comparison.findings import corrections
from handeye.comparison.pairing import TwoRuns
from handeye.comparison.text import comparison_text
from handeye.core.errors import InvalidInput
from handeye.core.faults import Fault
from handeye.core.variation import WorldSpec
from handeye.program.events import Event, GuardTripped, StepStarted, UndoFinished, UndoStarted
from handeye.report.recorded import RecordedRun
from handeye.trace.reading import read_trace


def with_events(path: Path, number: int, **fields: object) -> RecordedRun:
    """The made-up run, in which fields of the event of a number are others."""
    recording = Recording(path).begin()
    write, events = recording.recorder.event, iter(range(len(EVENTS)))

    def altered(event: Event) -> None:
        write(msgspec.structs.replace(event, **fields) if next(events) == number else event)

    recording.recorder.event = altered  # type: ignore[method-assign]
    recording.play().close()
    return RecordedRun(trace=read_trace(path))


def answer(command: Command, *words: str) -> dict[str, Any]:
    """What the command tells programs."""
    code, out, _ = command("compare", *words, "--json")
    assert code == 0
    return json.loads(out)


def test_a_run_is_the_same_as_itself(command: Command, tmp_path: Path) -> None:
    record(tmp_path / "a.mcap")
    told = answer(command, "a.mcap", "a.mcap")
    assert (told["same"], told["first"], told["parted"], told["conditions"]) == (True, None, None, [])
    assert [stage["name"] for stage in told["stages"]] == ["open", "close", "again"]
    said = command("compare", "a.mcap", "a.mcap")[1]
    assert said.endswith("\n\nBoth runs are identical, to the last bit.\n")


def test_programs_are_told_step_line_quantity_and_both_values(command: Command, tmp_path: Path) -> None:
    record(tmp_path / "a.mcap")
    number = next(n for n, event in enumerate(EVENTS) if isinstance(event, GuardTripped))
    with_events(tmp_path / "b.mcap", number, value=9.5)
    first = answer(command, "a.mcap", "b.mcap")["first"]
    named = {key: first[key] for key in ("stage", "step", "line", "quantity", "unit", "a", "b", "period")}
    assert named == {
        "stage": "open", "step": 0, "line": 2, "quantity": "GuardTripped.value", "unit": "N", "a": 9.0, "b": 9.5,
        "period": None,
    }  # fmt: skip


_NO_PLACES = "an event list, which holds no positions"


@pytest.mark.parametrize(
    ("name", "content", "said"),
    [
        ("nowhere", None, "nowhere: there is no such file"),
        ("events.jsonl", "", f"events.jsonl is {_NO_PLACES}; use the trace.mcap"),
        ("b.mcap", "no trace", "b.mcap is not a trace: it is not an MCAP file"),
    ],
)  # fmt: skip
def test_what_is_no_run_is_refused_in_a_sentence(
    command: Command, tmp_path: Path, name: str, content: str | None, said: str
) -> None:
    record(tmp_path / "a.mcap")
    if content is not None:
        (tmp_path / name).write_text(content, encoding="utf-8")
    for words in (("a.mcap", name), (name, "a.mcap")):
        assert command("compare", *words) == (2, "", f"handeye: {said}\n")


def test_a_run_of_another_system_is_refused(tmp_path: Path) -> None:
    run = recorded(tmp_path / "a.mcap")
    other = replace(
        run, trace=replace(run.trace, head=msgspec.structs.replace(run.trace.head, system=TOY.name))
    )
    with pytest.raises(InvalidInput, match=r"a\.mcap: the counter machine cannot compare two of its runs$"):
        comparison(run, other)


def test_a_run_with_a_step_that_its_plan_lacks_is_refused(tmp_path: Path) -> None:
    def astray(event: Event) -> Event:
        return msgspec.structs.replace(event, step=99) if isinstance(event, StepStarted) else event

    run = recorded(tmp_path / "a.mcap")
    with pytest.raises(InvalidInput, match=r"^the trace .*a\.mcap has steps that are not in its plan$"):
        comparison(run, changed(run, astray))


def test_a_step_that_the_arm_takes_back_is_none_that_it_carried_out(tmp_path: Path) -> None:
    run = recorded(tmp_path / "a.mcap")
    begun = [event for event in run.trace.events if isinstance(event, StepStarted)]
    ends = run.trace.events[-1].time
    back = [
        event
        for each in reversed(begun)
        for event in (
            UndoStarted(time=ends, step=each.step, line=each.line, text=each.text),
            UndoFinished(time=ends, step=each.step, hand=None, planned=None, gap=None, force=0.0),
        )
    ]
    undone = replace(run, trace=replace(run.trace, events=(*run.trace.events, *back)))
    both = TwoRuns(run, undone)
    assert len(both.carried_out[0]) == len(both.carried_out[1]) == len(begun)


def test_a_fault_is_told_as_it_would_be_typed(tmp_path: Path) -> None:
    broken = WorldSpec(seed=7, faults=(Fault(name="force.off_zero.z", value=20.0, stage=2),))
    (found,) = conditions_of(recorded(tmp_path / "a.mcap"), world=broken)
    assert (found.what, found.a, found.b) == ("fault force.off_zero.z", "none", "force.off_zero.z=20N@2")


def test_a_message_that_is_none_is_refused(tmp_path: Path) -> None:
    run = recorded(tmp_path / "a.mcap")
    broken = tuple(
        replace(message, data=b"{") if message.topic == "/hand" else message for message in run.trace.messages
    )
    with pytest.raises(InvalidInput, match=r"^a message in .*a\.mcap or .*a\.mcap cannot be decoded$"):
        comparison(run, replace(run, trace=replace(run.trace, messages=broken)))


def conditions_of(run: RecordedRun, **fields: object) -> tuple[Condition, ...]:
    """In what a run whose head has other fields depended on something else; all else of it is compared all the same."""
    head = msgspec.structs.replace(run.trace.head, **fields)
    found = comparison(run, replace(run, trace=replace(run.trace, head=head)))
    assert found.same
    return found.conditions


def test_a_world_of_another_version_is_compared_as_well_and_told(tmp_path: Path) -> None:
    run = recorded(tmp_path / "a.mcap")
    (found,) = conditions_of(run, world=WorldSpec(seed=7, drawing=3))
    assert (found.what, found.a, found.b) == ("drawing of the world", "4", "3")


def test_runs_of_different_tasks_are_compared_as_far_as_they_go_and_it_says_so(tmp_path: Path) -> None:
    run = recorded(tmp_path / "a.mcap")
    (found,) = conditions_of(run, task="block")
    assert (found.what, found.a, found.b) == ("task", "water_pump", "block")


def test_a_run_that_was_interrupted_differs_where_it_ends(tmp_path: Path) -> None:
    run = recorded(tmp_path / "a.mcap")
    Recording(tmp_path / "b.mcap").begin().play(last=19).close()
    found = comparison(run, RecordedRun(trace=read_trace(tmp_path / "b.mcap")))
    assert found.first is not None
    assert found.first.place is not None
    assert (found.first.differing.name, found.first.place.line) == ("step", 4)
    assert found.first.b is None


@pytest.fixture(scope="module")
def missed(tmp_path_factory: pytest.TempPathFactory) -> Comparison:
    """A block grasped, beside one that stands so far off that the fingers close on nothing."""
    folder = tmp_path_factory.mktemp("missed")
    grasped, off = block_start(), block_start(**{"block.x": 0.05})
    return comparison(kept(folder / "grasped", grasped), kept(folder / "off", off))


@pytest.mark.slow
def test_the_text_names_the_first_difference_and_the_divergence(missed: Comparison) -> None:
    text = "\n".join(comparison_text(missed))
    assert "block.x: as drawn in A, 0.05m in B\n\nFirst difference: reach, line 3: OPEN 2.4\n" in text
    assert (
        "\nThe runs diverge: grasp, line 10: CLOSE .8\n"
        "  A: continues at line 11: CHANGE [0 0 1] .2\n"
        "  B: error 2: the fingers closed beyond the minimum gap: "
    ) in text


@pytest.mark.slow
def test_corrections_are_told_where_they_are_more_than_a_hair_apart(missed: Comparison) -> None:
    def told_of(*apart: float) -> str:
        found = tuple(each for x in apart for each in corrections(TwoRuns(told(saved(x)), told(saved(0.0)))))
        return "\n".join(comparison_text(replace(missed, corrections=found)))

    assert "Corrections: 1 in both, 1 within 0.02 in of each other\n\n" in told_of(0.0005)
    said = told_of(0.0005, 0.00254)
    assert "Corrections: 2 in both, 1 within 0.02 in of each other\n" in said
    assert "C1 in A (0.10, 0.00, 0.00) in, in B (0.00, 0.00, 0.00) in: 0.10 in apart" in said
