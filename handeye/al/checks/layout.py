"""Check the layout of a text for what it seems to say and the language does not: blanks before or between lines."""

from bisect import bisect_right
from collections.abc import Iterator, Sequence

from handeye.al.definition import DECLARATION, JUMP, MODIFIER, SHIFT
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.syntax import Macro, Name, Script, Statement
from handeye.al.word_groups import SKIPS
from handeye.core.diagnostics import Diagnostic, Label, quoted
from handeye.core.source import Source

_NO_STEP = frozenset(i.op for i in INSTRUCTIONS.values() if i.role in (DECLARATION, SHIFT))
"""Words that a skip passes over, or takes with the step before."""
_LEADS_AWAY = frozenset(i.op for i in INSTRUCTIONS.values() if i.role is JUMP) | {*SKIPS, "WAIT"}
"""Behind these the program need not go on with the next line."""
_BEGINNINGS = ("MOVE", "PARK")
"""Motions with which a program may well begin, behind its macros."""
_BODY = 2
"""Steps that are more than a skip can skip."""


def check_layout(script: Script, source: Source) -> Iterator[Diagnostic]:
    """A warning for each place, of a script without mistakes."""
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
    """Skips with two or more lines behind them that stand farther in, as if all of them were skipped."""
    for number, statement in enumerate(statements):
        skip = statement.word
        if number == 0 or skip is None or skip.text not in SKIPS:
            continue
        before, behind = statements[number - 1].word, _steps_behind(statements, number)
        if before is None or len(behind) < _BODY or behind[0].text in _LEADS_AWAY:
            continue
        here = _column(skip, source)
        if here == _column(before, source) and all(_column(word, source) > here for word in behind):
            yield Diagnostic(
                code="skips-one-only",
                message=f"`{skip.text}` skips one instruction, not the indented block",
                primary=Label(span=skip.span),
                secondary=(Label(span=behind[-1].span, text="this is carried out in any case"),),
                help="to skip more, write the opposite test and a `JUMP`",
            )


def _steps_behind(statements: Sequence[Statement], skip: int) -> list[Name]:
    """The words of the steps behind a skip, as many as make a body, up to a label."""
    words: list[Name] = []
    for number in range(skip + 1, len(statements)):
        word = statements[number].word
        if statements[number].labels or len(words) == _BODY:
            break
        if word is not None and word.text not in _NO_STEP:
            words.append(word)
    return words


def _column(word: Name, source: Source) -> int:
    """Column of a word on its line."""
    text, start = source.find(word.start)
    return len(text.text[text.text.rfind("\n", 0, start) + 1 : start].expandtabs())


def _modifies(statement: Statement) -> bool:
    word = statement.word
    return word is not None and word.text in INSTRUCTIONS and INSTRUCTIONS[word.text].role is MODIFIER


def _torn(macro: Macro, behind: Statement, source: Source) -> Iterator[Diagnostic]:
    """A macro that ends with a modifier, where blank lines part it from the motion below."""
    modifier, motion = macro.body[-1].word, behind.word
    assert modifier is not None
    if motion is None or motion.text in _BEGINNINGS or motion.text not in INSTRUCTIONS[modifier.text].fits:
        return
    text, end = source.find(macro.body[-1].end)
    other, start = source.find(behind.start)
    if other is text and not text.text[end:start].strip():
        yield Diagnostic(
            code="macro-ends-early",
            message=f"macro {quoted(macro.name.text)} ends with `{modifier.text}`, and its motion is outside",
            primary=Label(span=modifier.span),
            secondary=(Label(span=motion.span, text="this is after the macro"),),
            help="a blank line ends a macro: remove it, or write a comment there",
        )
