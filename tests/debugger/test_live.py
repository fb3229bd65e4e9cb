"""A run while it goes, by a system without physics: lines told as they begin, pauses asked for, lines refused."""

from collections.abc import Callable, Iterator

import msgspec
import pytest
from short_runs import history
from toy_system import begin_toy

from handeye.debugger.live import LineInput, Live
from handeye.debugger.reply import Reply
from handeye.debugger.stepper import Stepper, interact
from handeye.program.events import StepStarted
from handeye.runs.advance import advance
from handeye.runs.runner import Runner

CALLED = "brakes set, operator called: the operator is wanted"
GOING = "while the run moves, only `pause` and `pace` are accepted"


@pytest.fixture
def stepper() -> Stepper:
    """A run of eighteen steps, the operator called behind the seventeenth."""
    return Stepper(Runner(begin_toy()))


def typed_at(stepper: Stepper, said: dict[int, list[str]]) -> Callable[[], str | None]:
    """Somebody who types lines while steps are under way, given by how many have begun."""

    def typed() -> str | None:
        begun = sum(isinstance(event, StepStarted) for event in stepper.session.runner.events)
        lines = said.get(begun, [])
        return lines.pop(0) if lines else None

    return typed


def heard(stepper: Stepper, said: dict[int, list[str]]) -> list[Reply]:
    """The answers to what is typed while the run goes, as they come."""
    replies: list[Reply] = []
    stepper.session.input = LineInput(
        typed_at(stepper, said), lambda line: replies.append(stepper.meanwhile(line))
    )
    return replies


def told(
    stepper: Stepper, *lines: str, said: dict[int, list[str]], json: bool = False, width: int = 80
) -> str:
    """All that is put out for some lines of input, with others typed while the run goes."""
    out: list[str] = []
    live = Live(typed=typed_at(stepper, said), put=out.append, width=width)
    interact(stepper, iter(lines), lambda text: out.append(text + "\n"), json=json, live=live)
    return "".join(out)


# -- pauses ---------------------------------------------------------------------------------------------


def test_a_pause_that_is_asked_for_comes_behind_the_step_under_way(stepper: Stepper) -> None:
    replies = heard(stepper, {3: ["pause"]})
    paused = stepper.do("continue")
    assert (paused.position, paused.said) == (3, "paused on request")
    assert [reply.said for reply in replies] == ["the run will pause after the current step"]


def test_a_run_that_was_paused_goes_the_same_way_as_another(stepper: Stepper) -> None:
    unbroken = Runner(begin_toy())
    advance(unbroken)
    heard(stepper, {2: ["pause"], 9: ["pause", "pause"]})
    assert [stepper.do("c").position for _ in range(3)] == [2, 9, 17]
    assert history(stepper.session.runner.events) == history(unbroken.events)


@pytest.mark.parametrize("command", ["step 3", "until 4"])
def test_a_pause_is_forgotten_where_the_run_stops_anyway(stepper: Stepper, command: str) -> None:
    heard(stepper, {3: ["pause"]})
    assert stepper.do(command).said != "paused on request"
    assert stepper.do("step 4").position == 7


def test_a_pause_is_asked_of_a_run_that_goes_on_alone(stepper: Stepper) -> None:
    assert stepper.do("pause").error == "the run is already paused"
    stepper.do("step 9")
    del stepper.session.runner.history[1:-1]
    replies = heard(stepper, {5: ["pause"]})
    assert stepper.do("back").position == 8
    refusal = "the run is already going back to an earlier state, and pauses there"
    assert [reply.error for reply in replies] == [refusal]


# -- lines that are typed while the run goes ------------------------------------------------------------


def test_what_is_said_while_the_run_goes_is_refused_at_once_and_never_carried_out(stepper: Stepper) -> None:
    replies = heard(stepper, {3: ["back", "stpe", "pace 0x"]})
    assert stepper.do("step 5").position == 5
    assert [reply.error for reply in replies] == [
        f"`back` was ignored: {GOING}",
        "there is no command `stpe`; did you mean `step`?",
        "`pace` takes `1x`, `4x`, another number from 0.25x to 100x, or `free`, not `0x`",
    ]
    assert stepper.refused


def test_the_pace_can_be_set_while_the_run_goes(stepper: Stepper) -> None:
    replies = heard(stepper, {3: ["pace 4x"], 4: ["pace"]})
    stepper.do("step 5")
    assert [reply.said for reply in replies] == ["pace: 4 times real time"] * 2
    assert stepper.session.pace.factor == 4


def test_nobody_is_heard_while_the_run_pauses(stepper: Stepper) -> None:
    lines: Iterator[str] = iter(["quit"])
    stepper.session.input = LineInput(lambda: next(lines, None), lambda _: None)
    stepper.do("show time")
    assert next(lines) == "quit"


def test_who_looks_on_is_gone_when_the_run_pauses_however_it_came_to_that(stepper: Stepper) -> None:
    def typed() -> str | None:
        raise KeyboardInterrupt

    stepper.session.input = LineInput(typed, lambda _: None)
    with pytest.raises(KeyboardInterrupt):
        stepper.do("continue")
    assert (stepper.session.runner.observers, stepper.session.going, stepper.session.runner.position) == (
        [],
        None,
        0,
    )


# -- the two faces --------------------------------------------------------------------------------------


def test_in_text_a_line_is_told_when_it_begins_and_then_its_outcome_beneath_if_there_is_no_room(
    stepper: Stepper,
) -> None:
    pieces: list[str] = []
    live = Live(typed=lambda: None, put=pieces.append, width=80)
    stepper.do("step 16")
    interact(stepper, iter(["step"]), pieces.append, live=live)
    assert pieces[1:5] == ["      — stage “ask”", "    5 CALL B", "\n", f"        {CALLED}"]


def test_a_way_that_was_told_live_reads_as_one_that_was_told_at_its_end() -> None:
    def said(live: bool) -> str:
        out: list[str] = []
        way = Live(typed=lambda: None, put=out.append, width=110) if live else None
        lines = iter(["step 3", "set register B 7", "continue", "proceed", "step", "quit"])
        interact(Stepper(Runner(begin_toy())), lines, lambda text: out.append(text + "\n"), live=way)
        return "".join(out)

    assert said(live=True) == said(live=False)


def test_a_line_that_is_said_meanwhile_ends_the_line_under_way(stepper: Stepper) -> None:
    rows = told(stepper, "step 2", said={2: ["back"]}).splitlines()
    assert rows[7:10] == ["    2 ADD B 1", f"`back` was ignored: {GOING}", "    2 ADD B 1"]


def test_as_json_each_step_is_told_as_it_begins_and_every_line_has_an_answer(stepper: Stepper) -> None:
    out = [
        msgspec.json.decode(line)
        for line in told(stepper, "c", "q", said={2: ["s", "pause"]}, json=True).splitlines()
    ]
    assert [each["under_way"]["line"] if "under_way" in each else each["command"] for each in out] == [
        1, 2, "s", "pause", "c", "q",
    ]  # fmt: skip
    assert out[1]["under_way"] == {
        "position": 1, "time": 1.0, "stage": "count", "stage_number": 1, "step": 1, "line": 2,
        "text": "ADD B 1", "script": "",
    }  # fmt: skip
    assert (out[2]["error"], out[4]["pause"]["met"]) == (
        f"`step` was ignored: {GOING}",
        {"stop": "Asked"},
    )
    assert len(out[4]["did"]) == 3
