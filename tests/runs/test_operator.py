"""What operators say when they are called, and what comes of it."""

import pytest
from msgspec.structs import replace
from short_runs import begin, history, plan_of
from stepper_bench import AIR, reset

from handeye.core.errors import InvalidInput
from handeye.debugger.ask import Ask
from handeye.debugger.breakpoints import breakpoint
from handeye.program.events import (
    OperatorAnswered,
    OperatorCalled,
    StageFinished,
    StageStarted,
    StageUndone,
    StepStarted,
    UndoOrdered,
)
from handeye.results.pauses import pause_sentence
from handeye.runs.advance import AfterStage, Pause
from handeye.runs.observer import Observer
from handeye.runs.operator import Abort, Back, Retry, UnwindOnce, attend, beginnings, parse_policy
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint

SEARCHED = AfterStage(stage=1, name="search in the air")

pytestmark = pytest.mark.slow

CALLED = "the fingers closed beyond the minimum gap: there is nothing between them, or the object is too thin"


@pytest.fixture(scope="module")
def built() -> Runner:
    return Runner(begin(AIR))


@pytest.fixture
def runner(built: Runner) -> Runner:
    """A run that calls the operator in its third stage, each time that is tried."""
    return reset(built)


class Talk:
    """Answers, and what was said to whoever gave them."""

    def __init__(self, *answers: str) -> None:
        self.said: list[str] = []
        self.operator = Ask(iter(answers), self.said.append)


def answers(runner: Runner) -> list[str]:
    """What the operator chose."""
    return [event.choice for event in runner.events if isinstance(event, OperatorAnswered)]


def calls(runner: Runner) -> int:
    """How often the operator was called."""
    return sum(isinstance(event, OperatorCalled) for event in runner.events)


def texts(runner: Runner) -> list[str]:
    """The statements that were carried out."""
    return [event.text for event in runner.events if isinstance(event, StepStarted)]


# -- policies -------------------------------------------------------------------------------------------


def test_policies_are_written_in_a_word() -> None:
    assert [parse_policy(text, ()) for text in ("abort", "retry:3", "ask")] == [Abort(), Retry(3), None]
    assert (
        parse_policy("unwind:2", ("one", "two")) == parse_policy("unwind:tw", ("one", "two")) == UnwindOnce(1)
    )
    assert parse_policy("unwind", ()) == UnwindOnce()


@pytest.mark.parametrize("text", ["", "retry", "retry:0", "retry:-1", "retry:x", "Abort", "retry:1.5"])
def test_another_policy_is_refused_in_a_sentence(text: str) -> None:
    with pytest.raises(
        InvalidInput,
        match=r"^--on-stop takes abort, ask, retry:N \(N is at least 1\), unwind or unwind:STAGE, not .*$",
    ):
        parse_policy(text, ())


def test_a_stage_that_is_not_there_cannot_be_unwound_to() -> None:
    with pytest.raises(InvalidInput, match=r"^there is no stage `three`; the program has 1 `one`, 2 `two`$"):
        parse_policy("unwind:three", ("one", "two"))


def unwound(runner: Runner) -> list[int]:
    """How many executed steps were to be left when the arm was told to undo."""
    return [event.left for event in runner.events if isinstance(event, UndoOrdered)]


def test_unwinding_undoes_by_the_arm_what_was_done_since_a_stage_began_and_tries_again_once(
    runner: Runner,
) -> None:
    pause = attend(runner, UnwindOnce(1))
    assert (pause.kind, calls(runner), len(unwound(runner))) == ("operator", 2, 1)
    started = [event.stage for event in runner.events if isinstance(event, StageStarted)]
    undone = [event.stage for event in runner.events if isinstance(event, StageUndone)]
    assert undone == [started[2], started[1]]
    assert started == [*started[:3], *started[1:3]]


def test_without_a_name_the_stage_that_fails_is_undone(runner: Runner) -> None:
    assert attend(runner, UnwindOnce()).kind == "operator"
    started = [event.stage for event in runner.events if isinstance(event, StageStarted)]
    assert [event.stage for event in runner.events if isinstance(event, StageUndone)] == [started[2]]
    assert (started[2:], len(unwound(runner))) == ([started[2]] * 2, 1)


def test_the_operator_can_have_the_arm_undo_a_stage(runner: Runner) -> None:
    talk = Talk("unwind", "a")
    attend(runner, talk.operator)
    assert (calls(runner), len(unwound(runner))) == (2, 1)


def test_a_stage_that_has_not_begun_cannot_be_unwound_to(runner: Runner) -> None:
    assert attend(runner, UnwindOnce(len(runner.listing.stages) - 1)).kind == "operator"
    assert calls(runner) == 1 + len(unwound(runner))


def test_abort_ends_the_run_where_the_operator_was_called(runner: Runner) -> None:
    pause = attend(runner, Abort())
    assert (pause.kind, calls(runner), answers(runner)) == ("operator", 1, [])
    assert runner.call is not None


@pytest.mark.parametrize("times", [1, 3])
def test_retry_does_the_stage_again_so_many_times_and_gives_up(runner: Runner, times: int) -> None:
    assert attend(runner, Retry(times)).kind == "operator"
    assert answers(runner) == ["retry"] * times
    assert calls(runner) == times + 1


def test_what_a_step_leaves_for_undoing_it_tells_that_it_called_the_operator(runner: Runner) -> None:
    attend(runner, Abort())
    called = [done.called for done in runner.context.state.done]
    assert called == [*(len(called) - 1) * [False], True]


def test_where_the_arm_cannot_undo_something_nothing_is_retried(runner: Runner) -> None:
    attend(runner, Abort())
    state = runner.context.state
    state.done[-1] = replace(state.done[-1], way=b"no way")
    runner.order_reversal(0, halts=True)
    assert attend(runner, Retry(3)).kind == "operator"
    assert answers(runner) == []
    assert runner.kind.choices(runner)["proceed"] == "proceed: continue undoing"


def test_a_part_that_begins_when_all_is_undone_is_retried_on_its_own_account(runner: Runner) -> None:
    attend(runner, Retry(1))
    runner.order_reversal(0, halts=True)
    attend(runner, Retry(1))
    runner.answer("proceed")  # built again
    attend(runner, Retry(1))
    assert answers(runner) == ["retry", "proceed", "retry"]


def test_a_run_taken_up_again_retries_no_more_often_than_one_never_broken_off(runner: Runner) -> None:
    kept: list[Checkpoint] = []

    class Keep(Observer):
        def checkpoint(self, checkpoint: Checkpoint) -> None:
            kept.append(checkpoint)

    runner.observers.append(Keep())
    attend(runner, Retry(2))
    once_retried = next(c for c in kept if any(isinstance(e, OperatorAnswered) for e in c.events))
    again = Runner(once_retried)
    attend(again, Retry(2))
    assert history(again.events) == history(runner.events)


def test_each_stage_is_retried_on_its_own_account() -> None:
    runner = Runner(begin('STAGE "one"\nWAIT HERE\nSTAGE "two"\nWAIT THERE\n'))
    attend(runner, Retry(1))
    runner.answer("proceed")
    assert attend(runner, Retry(1)).kind == "operator"
    assert answers(runner) == ["retry", "proceed", "retry"]


# -- asking ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("answer", "last"), [("p", "OPEN    .4"), ("proceed", "OPEN    .4"), ("s", "OPEN    .5")]
)
def test_the_program_goes_on_as_the_answer_says(runner: Runner, answer: str, last: str) -> None:
    talk = Talk(answer)
    assert attend(
        runner, talk.operator, [breakpoint("shut", plan_of(AIR).program)] if answer != "s" else []
    ).kind
    assert texts(runner)[-1] == last


def test_retry_goes_on_with_the_first_step_of_the_stage(runner: Runner) -> None:
    attend(runner, Talk("r", "a").operator)
    assert texts(runner)[-4:] == ["OPEN    .5", "CLOSE   .4"] * 2


def test_going_back_to_a_stage_makes_all_since_then_undone(runner: Runner) -> None:
    attend(runner, Talk("a").operator)
    first = history(runner.events)
    reset(runner)
    attend(runner, Talk("b", "b search", "b 1", "a").operator)
    assert history(runner.events) == first


def test_the_question_says_what_happened_where_and_what_can_be_said(runner: Runner) -> None:
    talk = Talk("a")
    attend(runner, talk.operator)
    assert talk.said[0].splitlines() == [
        "The program calls the operator in stage 3, grasp nothing:",
        f"    {CALLED} (gap 0.00 in, minimum 0.40 in)",
        '    17          STAGE   "grasp nothing"',
        "    18          OPEN    .5",
        "  ■ 19          CLOSE   .4",
        "    20          OPEN    .4",
        '    21          STAGE   "shut the hand"',
        "p          proceed: continue at line 20",
        "r          retry the stage from line 18, in the world as it is now",
        "s          skip the rest of the stage",
        "b [STAGE]  go back in time to the beginning of this stage, or of the earlier STAGE",
        "u [STAGE]  unwind: the arm undoes its work back to the beginning of this stage, and the program continues "
        "from there",
        "a          abort",
        "show       show the state of the run, or one topic of it",
    ]


def test_the_end_of_the_answers_is_taken_for_abort(runner: Runner) -> None:
    talk = Talk()
    assert attend(runner, talk.operator).kind == "operator"
    assert talk.said[-1] == "the input has ended: the run is aborted"


@pytest.mark.parametrize(
    ("answer", "sentence"),
    [
        ("maybe", "`maybe` is not an answer; type p, r, s, b, u, a or show"),
        ("", "`` is not an answer; type p, r, s, b, u, a or show"),
        ("p 3", "`p 3` is not an answer; type p, r, s, b, u, a or show"),
        ("b shut", "stage 4, shut the hand, has not begun yet"),
        (
            "b nowhere",
            "there is no stage `nowhere`; the program has 1 `open the hand`, 2 `search in the air`, "
            "3 `grasp nothing`, 4 `shut the hand`",
        ),
        ("show tee", "there is no `tee` to show; did you mean `time`?"),
    ],
)
def test_an_answer_that_is_none_is_told_and_asked_for_again(
    runner: Runner, answer: str, sentence: str
) -> None:
    talk = Talk(answer, "a")
    assert attend(runner, talk.operator).kind == "operator"
    assert talk.said[1:] == [sentence]


def test_whoever_is_asked_can_look_first(runner: Runner) -> None:
    talk = Talk("show saved", "a")
    attend(runner, talk.operator)
    assert talk.said[1].startswith("saved     H  (")


# -- stopping elsewhere ---------------------------------------------------------------------------------


def test_a_stage_that_is_skipped_has_ended(runner: Runner) -> None:
    pause = attend(runner, Talk("s").operator, [AfterStage(stage=2, name="grasp nothing")])
    assert pause == Pause(kind="break", next=13, met=AfterStage(stage=2, name="grasp nothing"))
    assert [event.status for event in runner.events if isinstance(event, StageFinished)][-1] == "skipped"


def test_a_break_where_the_program_goes_on_after_an_answer_stops_it_and_the_state_is_kept(
    runner: Runner,
) -> None:
    kept: list[Checkpoint] = []

    class Keep(Observer):
        def checkpoint(self, checkpoint: Checkpoint) -> None:
            kept.append(checkpoint)

    runner.observers.append(Keep())
    pause = attend(runner, Talk("p").operator, [breakpoint("20", plan_of(AIR).program)])
    assert (pause.kind, pause_sentence(pause)) == ("break", "breakpoint at line 20")
    assert history(list(kept[-1].events)) == history(runner.events)


def test_a_run_that_nobody_needs_to_attend_to_comes_to_its_end(runner: Runner) -> None:
    asked: list[str] = []

    class Never:
        def answer(self, runner: Runner, call: OperatorCalled, refused: str | None) -> Back:
            asked.append(call.message)
            return Back(stage=0)

    pause = attend(runner, Never(), [SEARCHED])
    assert (pause.kind, asked) == ("break", [])


def test_stages_are_known_by_where_they_began(runner: Runner) -> None:
    attend(runner, Abort())
    assert beginnings(runner) == {0: 0, 1: 2, 2: 9}


def test_going_back_reaches_what_is_only_on_disk(runner: Runner) -> None:
    at_start = runner.checkpoint()
    attend(runner, Abort(), [SEARCHED])
    late = Runner(runner.checkpoint())
    attend(late, Talk("b 1", "a").operator, kept=lambda _: at_start)
    attend(runner, Abort())
    assert history(late.events) == history(runner.events)


@pytest.mark.parametrize("word", ["help", "?", "h"])
def test_help_says_again_what_can_be_said(runner: Runner, word: str) -> None:
    talk = Talk(word, "a")
    attend(runner, talk.operator)
    question, choices = talk.said
    assert choices.splitlines()[0] == "p          proceed: continue at line 20"
    assert question.endswith(choices)


def test_going_back_behind_what_was_kept_is_told_and_asked_for_again(runner: Runner) -> None:
    attend(runner, Abort(), [SEARCHED])
    talk = Talk("b 1", "a")
    pause = attend(Runner(runner.checkpoint()), talk.operator)
    assert pause.kind == "operator"
    assert (
        talk.said[1].splitlines()[1]
        == "    this run begins with 9 steps already done: there is no earlier state "
        "to go back to"
    )


def test_the_panic_button_on_the_way_back_stops_the_run(runner: Runner) -> None:
    at_start = runner.checkpoint()
    attend(runner, Abort(), [SEARCHED])
    pressed: list[bool] = []
    late = Runner(runner.checkpoint(), halt=lambda: bool(pressed and pressed.pop()))

    class Panic:
        def answer(self, runner: Runner, call: OperatorCalled, refused: str | None) -> Back:
            pressed.append(True)
            return Back(stage=1)

    pause = attend(late, Panic(), kept=lambda _: at_start)
    assert pause == Pause(kind="panic", next=late.at, back=True)
    assert pause_sentence(pause) == "stopped by the panic button while going back; the brakes are set"
