"""Checks of layout: indentation and blank lines that suggest a wrong meaning."""

from bisect import bisect_right
from collections.abc import Iterator, Sequence

from handeye.al.definition import DECLARATION, JUMP, MODIFIER, SHIFT
from handeye.al.instructions import INSTRUCTIONS, SKIPS
from handeye.al.syntax import Macro, Name, Script, Statement
from handeye.core.diagnostics import Diagnostic, Label, problem, quoted
from handeye.core.source import Source

_NOT_A_STEP = frozenset(i.op for i in INSTRUCTIONS.values() if i.role in (DECLARATION, SHIFT))
_LEAVES = frozenset(i.op for i in INSTRUCTIONS.values() if i.role is JUMP) | {*SKIPS, "WAIT"}
_OPENING_MOTIONS = ("MOVE", "PARK")  # often the first motion after the macros
_MIN_BODY = 2  # steps; a skip skips only one


def check_layout(script: Script, source: Source) -> Iterator[Diagnostic]:
    """Yield warnings about the layout of a script without errors."""
    for statements in (script.statements, *(macro.body for macro in script.macros.values())):
        yield from _bodies(statements, source)
    ending = [macro for macro in script.macros.values() if macro.body and _modifies(macro.body[-1])]
    if ending:
        ordered = sorted(script.statements, key=lambda statement: statement.start)
        starts = [statement.start for statement in ordered]
        for macro in ending:
            behind = bisect_right(starts, macro.body[-1].end)
            if behind < len(ordered):
                yield from _torn(macro, ordered[behind], source)


def _bodies(statements: Sequence[Statement], source: Source) -> Iterator[Diagnostic]:
    """Report skips that are followed by several lines with deeper indentation. The indentation suggests that all of
    these lines are skipped, but a skip skips only one instruction.
    """
    for number, statement in enumerate(statements):
        skip = statement.word
        if number == 0 or skip is None or skip.text not in SKIPS:
            continue
        before, behind = statements[number - 1].word, _steps_behind(statements, number)
        if before is None or len(behind) < _MIN_BODY or behind[0].text in _LEAVES:
            continue
        here = _column(skip, source)
        if here == _column(before, source) and all(_column(word, source) > here for word in behind):
            yield problem(
                "skips-one-only",
                f"`{skip.text}` skips one instruction, not the indented block",
                skip.span,
                Label(span=behind[-1].span, text="this line is always executed"),
                help="to skip more, write the opposite test and a `JUMP`",
            )


def _steps_behind(statements: Sequence[Statement], skip: int) -> list[Name]:
    """Return the words of the first steps after a skip: at most `_MIN_BODY` words, and none after the next label."""
    words: list[Name] = []
    for number in range(skip + 1, len(statements)):
        word = statements[number].word
        if statements[number].labels or len(words) == _MIN_BODY:
            break
        if word is not None and word.text not in _NOT_A_STEP:
            words.append(word)
    return words


def _column(word: Name, source: Source) -> int:
    """Return the column of a word, from 0, with tabs expanded."""
    text, start = source.find(word.start)
    return len(text.text[text.text.rfind("\n", 0, start) + 1 : start].expandtabs())


def _modifies(statement: Statement) -> bool:
    word = statement.word
    return word is not None and word.text in INSTRUCTIONS and INSTRUCTIONS[word.text].role is MODIFIER


def _torn(macro: Macro, behind: Statement, source: Source) -> Iterator[Diagnostic]:
    """Report a macro that ends in a modifier, if only blank lines separate the modifier from a motion that follows the
    macro.
    """
    modifier, motion = macro.body[-1].word, behind.word
    assert modifier is not None
    fits = {*INSTRUCTIONS[modifier.text].fits} - {*_OPENING_MOTIONS}
    if motion is None or motion.text not in fits:
        return
    text, end = source.find(macro.body[-1].end)
    other, start = source.find(behind.start)
    if other is text and not text.text[end:start].strip():
        yield problem(
            "macro-ends-early",
            f"macro {quoted(macro.name.text)} ends with `{modifier.text}`, but the motion that it modifies is "
            "outside the macro",
            modifier.span,
            Label(span=motion.span, text="this line is after the macro"),
            help="the blank line ends the macro: remove this line, or write a comment on it",
        )
