"""No message says `1 places`: a number before a noun goes through `counted`, unless it can never be 1."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

from handeye.core.plain_text import counted

ROOT = Path(__file__).parent.parent
NOUNS = (
    "place|step|time|stage|motion|trial|world|point|run|byte|file|line|event|second|minute|fault|error|picture|pump|screw|"
    "part|hole|word|program|position|row|column|pin|finger|joint|view|number|level|switch|period|message|finding|"
    "blob|beam|cell|task|system|machine|channel|worker|unit|character|degree|round|loop|guard|checkpoint|command|"
    "field|table|frame|turn|block|node|figure|case|calibration|photograph|exposure|seed|attempt|branch|sighting|knot|"
    "measurement|solid|reversal"
)
ADJECTIVES = "tapped|dark|planned|guarded|servo|physics|pending|more|other|different|whole|new"
PLURAL = re.compile(rf"^ (?:(?:{ADJECTIVES}) )?(?:(?:{NOUNS})e?s|entries|tries|axes|quantities)\b")
NEVER_ONE = {
    ("handeye/results/arm_export.py", "len(self.joints)"),  # of an arm: six
    ("handeye/agents/bench_page.py", "result.seeds"),  # a word
    ("handeye/cli/rare.py", "self.n"),  # at least 20
    ("handeye/al/macros.py", "len(line.text)"),  # beyond a limit, as the next
    ("handeye/al/parser.py", "line.end - line.start"),
    ("handeye/agents/bench_result.py", "result.seeds"),  # a word, as the next
    ("handeye/cli/agents.py", "result.seeds"),
    ("handeye/cell/exposures.py", "self.exposures"),
    ("handeye/systems/ml/cli/commands.py", "each.category"),  # a name
    ("handeye/systems/trig/language/place.py", "len(word)"),
    ("handeye/video/formats.py", "frames"),
    ("handeye/al/operand_help.py", "len(operand.units)"),  # components of a vector: three or two, as the next
    ("handeye/al/operands.py", "len(operand.units)"),
    ("handeye/al/operands.py", "quoted(count.text)"),  # a count that is no number
    ("handeye/execution/tool_axes.py", "count"),
    ("handeye/al/planning_messages.py", "round(parts) * 45"),
    ("handeye/planfile/soundness.py", "' and '.join(map(str, plan.joint_counts))"),
    ("handeye/program/stage_names.py", "len(found)"),  # several, as the next; one has a sentence of its own
    ("handeye/program/diagnosis/cause_text.py", "cause.blobs"),
    ("handeye/program/diagnosis/sense_text.py", "noise"),  # as many decimals as tell it from the limit
    ("handeye/report/page/seen.py", "rows"),  # of a picture, as the next
    ("handeye/report/page/seen.py", "columns"),
    ("handeye/vision/scan.py", "self.columns"),
    ("handeye/cell/opengl.py", "height"),
    ("handeye/editor/hover.py", "turned"),  # three angles
    ("handeye/report/page/record.py", "len(quantities)"),
    ("handeye/video/request.py", "self.speed"),  # as given, in what refuses it
    ("handeye/cli/sweeps.py", "sweep.kind"),  # a word
    ("handeye/cli/programs.py", "' or more' if errors == LIMIT else ''"),
    ("handeye/systems/ml/cli/commands.py", "category"),  # a word
    ("handeye/systems/ml/run/job_trials.py", "means['motions']"),  # a mean over worlds: over twenty
    ("handeye/systems/sigma/diagnosis/game.py", "len(FAULTS)"),
    ("handeye/systems/sigma/run/job_trials.py", "means['commands']"),  # a mean over boards: over a thousand
    ("handeye/systems/sigma/table1.py", "len(ROWS)"),
}
"""Numbers that are not 1 where the message is made, by file."""


def loose(source: str) -> Iterator[str]:
    """The numbers in a source that stand before a noun in the plural, whatever they are."""
    for text in (node for node in ast.walk(ast.parse(source)) if isinstance(node, ast.JoinedStr)):
        for number, after in zip(text.values, text.values[1:], strict=False):
            if not (isinstance(number, ast.FormattedValue) and isinstance(after, ast.Constant)):
                continue
            shown = ast.unparse(number.value)
            decimals = number.format_spec is not None and ".0f" not in ast.unparse(number.format_spec)
            if (
                PLURAL.match(str(after.value))
                and not shown.strip("_").isupper()
                and not decimals
                and not shown.startswith("enough_digits(")
            ):
                yield shown


@pytest.mark.slow
def test_numbers_before_nouns_are_counted() -> None:
    found = {
        (str(file.relative_to(ROOT)), shown)
        for file in sorted((ROOT / "handeye").rglob("*.py"))
        for shown in loose(file.read_text(encoding="utf-8"))
    }
    assert found <= NEVER_ONE


def test_a_loose_number_is_seen() -> None:
    source = (
        'f"{count} places tried"; f"{n} dark blobs"; f"{MOST} steps"; f"{x:.1f} degrees"; f"{name} has steps"'
    )
    assert list(loose(source)) == ["count", "n"]


def test_one_is_singular() -> None:
    assert [counted(n, noun) for n, noun in ((1, "place"), (0, "step"), (3, "try"), (2, "branch"), (2, "way"))] == [
        "1 place", "0 steps", "3 tries", "2 branches", "2 ways"
    ]  # fmt: skip
