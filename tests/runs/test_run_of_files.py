"""A run of a script sewn of several files: lines are those of each file."""

from collections.abc import Callable
from pathlib import Path

import pytest
from short_runs import begin, plan_of

from handeye.core.errors import InvalidInput
from handeye.debugger.breakpoints import breakpoint
from handeye.debugger.formatting import as_text
from handeye.debugger.listing import excerpt, excerpt_lines, listing_text
from handeye.debugger.reply import Reply
from handeye.debugger.stepper import Stepper
from handeye.planfile.plan import Plan
from handeye.results.pauses import stop_name
from handeye.runs.advance import AtSteps
from handeye.runs.runner import Runner

FILES = {
    "lib/hand.al": '        STAGE   "hand"\n        OPEN    .5\nLH:     OPEN    .4\n',
    "words.al": "DEFINE TWICE\n        OPEN    .3\n        OPEN    .2\n\n",
}
SCRIPT = "        REQUIRE words.al\n        OPEN    1\n        REQUIRE lib/hand.al\nLE:     TWICE\n"


@pytest.fixture(scope="module")
def plan() -> Plan:
    return plan_of(SCRIPT, tuple(FILES.items()))


@pytest.fixture
def say(tmp_path: Path) -> Callable[..., list[Reply]]:
    stepper = Stepper(Runner(begin(SCRIPT, files=tuple(FILES.items()))), pictures=tmp_path)
    return lambda *commands: [stepper.do(command) for command in commands]


def test_stages_are_listed_with_the_files_of_their_lines(plan: Plan) -> None:
    assert listing_text(plan.program) == [
        "  1  program     1 step  lines 2 to 2",
        "         0  line 2     OPEN 1",
        "  2  hand       4 steps  lines lib/hand.al:2 to 3",
        "         1  line lib/hand.al:2  OPEN .5",
        "         2  line lib/hand.al:3  OPEN .4",
        "         3  line words.al:2     OPEN .3",
        "         4  line words.al:3     OPEN .2",
    ]


def test_labels_of_required_files_stand_before_their_steps(plan: Plan) -> None:
    assert plan.program.labels == {"LH": [2], "LE": [3]}


def test_an_excerpt_of_a_required_file_names_it(plan: Plan) -> None:
    assert excerpt_lines(excerpt(plan.program, 2, 2, 1, "lib/hand.al")) == [
        "    lib/hand.al",
        '    1          STAGE   "hand"',
        "  → 2          OPEN    .5",
        "    3  LH:     OPEN    .4",
    ]


@pytest.mark.parametrize(
    ("text", "steps", "name"),
    [
        ("2", {0}, "line 2"),
        ("short:1", {0}, "line 2"),
        ("short.al:2", {0}, "line 2"),
        ("lib/hand.al:1", {1}, "line lib/hand.al:2"),
        ("hand.al:3", {2}, "line lib/hand.al:3"),
        ("words.al:3", {4}, "line words.al:3"),
    ],
)
def test_a_break_is_a_line_of_the_script_or_of_a_file(
    plan: Plan, text: str, steps: set[int], name: str
) -> None:
    stop = breakpoint(text, plan.program)
    assert isinstance(stop, AtSteps)
    assert (set(stop.steps), stop_name(stop)) == (steps, name)


@pytest.mark.parametrize(
    ("text", "message"),
    [
        (
            "feet.al:2",
            r"the script does not require a file `feet\.al`; it requires: `words\.al`, `lib/hand\.al`",
        ),
        ("hand.al:4", r"line lib/hand\.al:4 is after the last step, which is on line lib/hand\.al:3"),
        ("4", r"line 4 is after the last step, which is on line 2"),
    ],
)
def test_a_break_where_no_step_is_gets_a_sentence(plan: Plan, text: str, message: str) -> None:
    with pytest.raises(InvalidInput, match=f"^{message}$"):
        breakpoint(text, plan.program)


def test_the_stepper_shows_the_file_it_stands_in(say: Callable[..., list[Reply]]) -> None:
    begun, done = say("break hand.al:3", "continue")
    assert begun.breaks
    assert (done.script, done.line, done.text) == ("lib/hand.al", 3, "OPEN    .4")
    text = as_text(done).split("\n")
    assert [line.split()[0] for line in text if " OPEN " in line and "gap" in line] == ["2", "lib/hand.al:2"]
    assert "    lib/hand.al" in text
    assert "  → 3  LH:     OPEN    .4" in text


def test_the_stepper_lists_around_a_line_of_a_file(say: Callable[..., list[Reply]]) -> None:
    asked, wrong = say("list words.al:2", "list words.al:9")
    assert [(line.file, line.line, line.here) for line in asked.source][:2] == [
        ("words.al", 1, False),
        ("words.al", 2, False),
    ]
    assert wrong.error == "`list` takes a line from 1 to 4, not `words.al:9`"
