"""Plans the instructions that a person types. The plan begins at the arm's present configuration."""

from collections.abc import Collection, Sequence
from dataclasses import replace
from typing import Final

from handeye.al import AL
from handeye.al.parser import parse
from handeye.arm.model import ArmModel
from handeye.core.diagnostics import Diagnostic
from handeye.core.pose import Array
from handeye.core.source import Source
from handeye.planning.planner import PlannedScript, plan_source
from handeye.program.taught import Taught

TYPED: Final = "typed"  # used in place of a file name for typed functions
OPEN: Final = frozenset(
    {"modifier-without-motion", "unknown-label", "skip-at-end", "unterminated-macro", "empty-program"}
)  # mistakes that the next line of a text may correct
_ALONE: Final = frozenset(
    {
        "aoj-without-search", "search-without-aoj", "save-without-move", "travel-without-change",
        "specific-without-general", "torque-without-tool", "unused-label", "unused-macro",
        "unused-position", "unused-vector", "compared-without-hold",
    }
)  # fmt: skip
"""Codes of warnings about instructions that the typed text lacks. The user may have executed these instructions
before, or may type them later.
"""
_LASTING: Final = ("TRANS", "VECT")


def planned(
    source: Source,
    taught: Taught,
    arm: ArmModel,
    start: Array,
    *,
    task: str,
    saved: Collection[str] = (),
    alone: bool = False,
) -> PlannedScript:
    """Plan a text for an arm whose joint positions are `start` (rad or m, shape (n,)). `saved` are the names of
    saved differences.

    If `alone` is True, the text is planned alone, as a part of the work, and need not be complete.
    """
    made = plan_source(source, taught, arm, AL, task=task, start=start)
    told = [
        d
        for d in made.diagnostics
        if not (alone and d.code in _ALONE)
        and not (d.code == "never-saved" and source.marked(d.primary.span) in saved)
    ]
    return replace(made, diagnostics=told)


def mistakes(checked: PlannedScript, line: int) -> list[Diagnostic]:
    """Return mistakes that are in line number `line` of a text, or in the files that the text requires. Mistakes that
    a later line can correct are left out.
    """
    found = []
    for diagnostic in checked.diagnostics:
        text, offset = checked.source.find(diagnostic.primary.span.start)
        if diagnostic.code not in OPEN | _ALONE and (text.key or text.position(offset)[0] == line):
            found.append(diagnostic)
    return found


def lasting(lines: Sequence[str]) -> list[str]:
    """Return the lines that define macros, positions and vectors. These definitions remain valid for instructions that
    are executed alone.
    """
    script, _ = parse("\n".join(lines))
    written = [lines[s.line - 1] for s in script.statements if s.word is not None and s.word.text in _LASTING]
    for macro in script.macros.values():  # the text of the macro, and the blank line that ends it
        head = " ".join(["DEFINE", macro.name.text, *(parameter.text for parameter in macro.parameters)])
        written += [head, *(lines[statement.line - 1] for statement in macro.body), ""]
    return [*written, ""]


def is_open(lines: Sequence[str]) -> bool:
    """Return True if a macro definition has not ended yet. A blank line ends it."""
    return any(found.code == "unterminated-macro" for found in parse("\n".join(lines))[1])
