"""What the layout of a text seems to say and the language does not: blanks in front of a line, a line between lines."""

from bisect import bisect_right
from collections.abc import Iterator, Sequence

from handeye.al.definition import DECLARATION, JUMP, MODIFIER, SHIFT
from handeye.al.instructions import INSTRUCTIONS, SKIPS
from handeye.al.syntax import Macro, Name, Script, Statement
from handeye.diagnostics import Diagnostic, Label, quoted
from handeye.source import Source

_NO_STEP = frozenset(i.op for i in INSTRUCTIONS.values() if i.role in (DECLARATION, SHIFT))
_LEADS_AWAY = frozenset(i.op for i in INSTRUCTIONS.values() if i.role is JUMP) | SKIPS | {"WAIT"}
_BEGINNINGS = ("MOVE", "PARK")
"""Motions with which a program may well begin, behind its macros."""


def check_layout(script: Script, source: Source) -> Iterator[Diagnostic]:
    """A warning for each place, of a script without mistakes."""
    for statements in (script.statements, *(macro.body for macro in script.macros.values())):
        yield from _bodies(statements, source)
    torn = [macro for macro in script.macros.values() if macro.body and _modifies(macro.body[-1])]
    if torn:
        behind = sorted(script.statements, key=lambda statement: statement.start)
        starts = [statement.start for statement in behind]
        for macro in torn:
            at = bisect_right(starts, macro.body[-1].end)
            if at < len(behind):
                yield from _torn(macro, behind[at], source)


def _bodies(statements: Sequence[Statement], source: Source) -> Iterator[Diagnostic]:
    """Skips with two or more lines behind them that stand farther in, as if all of them were skipped."""
    skips = [n for n, s in enumerate(statements) if s.word is not None and s.word.text in SKIPS]
    for number in skips:
        skip, one, two = _steps(statements, number)
        if number == 0 or one is None or two is None or one.text in _LEADS_AWAY:
            continue
        before = statements[number - 1].word
        here = _column(skip, source)
        if _column(two, source) > here and _column(one, source) > here == _column(before, source):
            assert skip is not None
            yield Diagnostic(
                code="skips-one-only",
                message=f"`{skip.text}` skips one instruction, and not all that stands farther in",
                primary=Label(span=skip.span),
                secondary=(Label(span=two.span, text="this is carried out in any case"),),
                help="to leave out more, jump over it: the opposite test, and a `JUMP`",
            )


def _steps(statements: Sequence[Statement], skip: int) -> tuple[Name | None, Name | None, Name | None]:
    """The words of a skip and of the two steps behind it that no jump leads to."""
    words = [statements[skip].word]
    for number in range(skip + 1, len(statements)):
        word = statements[number].word
        if statements[number].labels or len(words) > 2:
            break
        if word is not None and word.text not in _NO_STEP:
            words.append(word)
    first, second, third, *_ = [*words, None, None]
    return first, second, third


def _column(word: Name | None, source: Source) -> int:
    """Where a word begins on its line, if there is one."""
    if word is None:
        return -1
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
            message=f"macro {quoted(macro.name.text)} ends with `{modifier.text}`, and the motion is not in it",
            primary=Label(span=modifier.span),
            secondary=(Label(span=motion.span, text="this is behind the macro"),),
            help="a blank line ends a macro: leave it out, or put a comment between the two",
        )
