"""A relay: programs that take the arm over from each other."""

import re
import shutil
from pathlib import Path

import pytest
from msgspec.structs import replace
from relay_bench import CARRY, RELAY, call, kept_in, on_disk, pin_relay, runner_of, start_of, to_end

from handeye.core.errors import BadFile, InvalidInput
from handeye.core.resources import plans
from handeye.core.source import Source, read_source
from handeye.program.events import StageStarted, UndoEnded, UndoOrdered
from handeye.runs.checkpoint_file import encode
from handeye.runs.folder import TRACE, open_again, open_new
from handeye.runs.hand_over import HandOver
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.relay.check import check_plan, misfits
from handeye.systems.relay.plan import made
from handeye.systems.relay.reading import parsed
from handeye.systems.relay.state import RelayCore


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("STAGE find a.al", 'a line must be STAGE "name of the stage" FILE'),
        ('STAGE "find" a.al b.al', 'a line must be STAGE "name of the stage" FILE'),
        ('STAGE " " a.al', "the stage has no name"),
        ('STAGE "a" a.al\nSTAGE "a" b.al', "the stage `a` is done by an earlier leg"),
        ('STAGE "a" a.py', "no system has a language for the file `a.py`"),
        ('STAGE "a" a.relay', "the relay cannot run a leg of a relay"),
        ('STAGE "a" /a.al', "`/a.al` must be a path from the folder of the relay"),
        ("; nothing", "the relay has no legs"),
    ],
)
def test_a_mistake_in_a_relay_is_named_at_its_line(text: str, message: str) -> None:
    found = parsed(Source(name="x.relay", text=text))[1]
    assert [each.message for each in found] == [message]


@pytest.mark.slow
def test_a_stage_that_its_program_does_not_have_is_refused_with_the_line(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"has no stage `lose the pin`"):
        pin_relay(tmp_path, RELAY.replace("take the pin", "lose the pin"))


@pytest.mark.slow
def test_a_leg_must_not_need_what_no_earlier_leg_finds(tmp_path: Path) -> None:
    check_plan(pin_relay(tmp_path))
    late = pin_relay(tmp_path, "\n".join(reversed(RELAY.splitlines())))
    assert [found.told for found in misfits(late)] == [
        "carry it on: carry.al, line 3: no earlier leg finds the difference C1"
    ]
    with pytest.raises(BadFile, match="no earlier leg finds"):
        runner_of(late)


@pytest.mark.slow
def test_a_leg_must_not_compare_a_picture_that_no_earlier_leg_takes(tmp_path: Path) -> None:
    wrong = pin_relay(
        tmp_path,
        carry=CARRY.replace("WAIT", "GENERAL BASE WIDE\n        WAIT")
        + """
        STAGE   "look"
        LOOK    WIDE
""",
    )
    assert "no earlier leg of this program takes the picture WIDE" in [
        each.sentence for each in misfits(wrong)
    ]


FIRST = 2, 6  # steps that are done when the second and the third leg begin


@pytest.fixture(scope="module")
def record(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A folder for the record of the run (`whole`), and for copies of it as each later leg begins (`2`, `6`)."""
    return tmp_path_factory.mktemp("record")


@pytest.fixture(scope="module")
def run(
    tmp_path_factory: pytest.TempPathFactory, record: Path
) -> tuple[Runner, list[str], dict[int, Checkpoint]]:
    """The relay, run to its end, with the checkpoints before its steps."""
    kept: dict[int, Checkpoint] = {}
    start = start_of(pin_relay(tmp_path_factory.mktemp("relay")))
    folder = open_new(record / "whole", start)
    runner = kept_in(folder, start, again=False)

    def note(now: Runner) -> None:
        kept[now.position] = now.checkpoint()
        if now.position in FIRST:
            folder.checkpoint(kept[now.position])
            shutil.copytree(folder.path, record / str(now.position))

    lines = to_end(runner, note)
    folder.close()
    return runner, lines, kept


Run = tuple[Runner, list[str], dict[int, Checkpoint]]


@pytest.mark.slow
def test_what_one_program_holds_and_found_another_one_carries_on(run: Run) -> None:
    runner, lines, _ = run
    assert runner.at is None
    assert runner.call is None
    assert [event.stage for event in runner.events if isinstance(event, StageStarted)] == [
        "go to the pin", "take the pin", "carry it on",
    ]  # fmt: skip
    assert any(
        '"LegStarted"' in line and '"held":"PIN"' in line and '"named":["C1"]' in line for line in lines
    )
    assert any('"Restored"' in line and '"C1"' in line for line in lines)


@pytest.mark.slow
def test_a_run_killed_in_any_leg_goes_on_byte_for_byte(run: Run) -> None:
    runner, lines, kept = run
    end = encode(runner.checkpoint())
    for position in (1, 4, 7):  # within each leg
        again = Runner(on_disk(kept[position]))
        assert to_end(again) == lines
        assert encode(again.checkpoint()) == end


@pytest.mark.slow
@pytest.mark.parametrize("done", FIRST)
def test_the_trace_of_a_run_killed_as_a_leg_begins_goes_on_byte_for_byte(
    run: Run, record: Path, done: int
) -> None:
    """The brakes that are set between the legs take time, which the trace keeps."""
    folder, newest, faults = open_again(record / str(done))
    assert not faults
    runner = kept_in(folder, newest, again=True)
    assert runner.position == done
    to_end(runner)
    folder.close()
    assert (folder.path / TRACE).read_bytes() == (record / "whole" / TRACE).read_bytes()


def refused(kept: dict[int, Checkpoint], change: "dict[str, object]") -> str:
    """What the last leg says when it takes the arm over with a changed record."""
    runner = Runner(on_disk(kept[6]))
    state = runner.system.state
    assert isinstance(state, RelayCore)
    assert isinstance(state.record, HandOver)
    state.records[-1] = replace(state.record, **change)
    runner.step()
    assert runner.ended
    return call(runner)


@pytest.mark.slow
@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (
            {"hand": (0.5, 0.5, 0.2, 0.0, 1.5, 0.0)},
            r"the hand is \d+.\d mm from its place in the hand-over record",
        ),
        ({"gap": 0.02}, r"says that the hand holds PIN with a gap of 20.0 mm, but the gap is \d.\d mm"),
        ({"units": ("in", "deg", "oz")}, "the hand-over record is in in, deg, oz; it must be in m, rad, N"),
        (
            {"named": {"place": {"C1": (0.0,) * 6}}},
            "`C1` is a place in the hand-over record, but the leg needs a",
        ),
        ({"named": {}}, "the hand-over record has no difference `C1`"),
        ({"named": {"difference": {"C1": (0.0,)}}}, "must have 3 finite numbers, not 1"),
    ],
)
def test_a_wrong_record_is_refused_with_a_sentence(
    run: Run, change: "dict[str, object]", sentence: str
) -> None:
    assert re.search(sentence, refused(run[2], change))


@pytest.mark.slow
def test_a_leg_that_was_refused_can_be_tried_again(run: Run) -> None:
    _, _, kept = run
    again = Runner(on_disk(kept[6]))
    state = again.system.state
    assert isinstance(state, RelayCore)
    record = state.record
    assert record is not None
    state.records[-1] = replace(record, gap=0.02)
    again.step()
    state.records[-1] = record
    again.answer("retry")
    to_end(again)
    assert again.at is None
    assert again.call is None
    assert [event.stage for event in again.events if isinstance(event, StageStarted)][-1] == "carry it on"


@pytest.mark.slow
@pytest.mark.parametrize("done", [6, 8])  # within the first program, and within the second
def test_undoing_goes_back_through_the_legs_of_all_programs(run: Run, done: int) -> None:
    runner = Runner(on_disk(run[2][done]))
    begun = len(runner.events)
    runner.order_reversal(0)
    while runner.system.executed:
        runner = runner if len(runner.system.executed) != 4 else Runner(on_disk(runner.checkpoint()))
        runner.step()
    assert runner.at == 0
    assert [event.left for event in runner.events if isinstance(event, UndoOrdered)] == [0]
    assert [event.step for event in runner.events[begun:] if isinstance(event, UndoEnded)] == [0]
    assert to_end(runner)
    assert runner.call is None
    assert [*runner.system.executed] == [*run[0].system.executed]


@pytest.mark.slow
def test_the_legs_of_the_relay_of_four_languages_fit_together() -> None:
    plan = made(read_source(plans() / "four_languages.relay"), plans())
    assert [*misfits(plan)] == []
    assert {program.system for program in plan.programs} == {"program", "trig", "ml", "sigma"}
