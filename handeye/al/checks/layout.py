"""What the layout of a text seems to say and the language does not: blanks in front of a line, a line between lines."""

from collections.abc import Iterator, Sequence
from typing import Final

from handeye.al.definition import MODIFIER, SKIP
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.syntax import Macro, Name, Script, Statement
from handeye.diagnostics import Diagnostic, Label, quoted
from handeye.source import Source

_SKIPS: Final = {i.op for i in INSTRUCTIONS.values() if i.role is SKIP}


def check_layout(script: Script, source: Source) -> Iterator[Diagnostic]:
    """A warning for each place, of a script without mistakes."""
    for statements in (script.statements, *(macro.body for macro in script.macros.values())):
        yield from _bodies(statements, source)
    for macro in script.macros.values():
        yield from _torn(macro, script, source)


def _bodies(statements: Sequence[Statement], source: Source) -> Iterator[Diagnostic]:
    """Skips with two or more lines behind them that stand farther in, as if all of them were skipped."""
    words = [None if statement.labels else statement.word for statement in statements]
    for number, skip in enumerate(words[1:-2], 1):
        if skip is None or skip.text not in _SKIPS:
            continue
        before, one, two = words[number - 1], words[number + 1], words[number + 2]
        here = _column(skip, source)
        if _column(two, source) > here == _column(before, source) and _column(one, source) > here:
            assert two is not None
            yield Diagnostic(
                code="skips-one-only",
                message=f"`{skip.text}` skips one instruction, and not all that stands farther in",
                primary=Label(span=skip.span),
                secondary=(Label(span=two.span, text="this is carried out in any case"),),
                help="to leave out more, jump over it: the opposite test, and a `JUMP`",
            )


def _column(word: Name | None, source: Source) -> int:
    """Where a word begins on its line; before all others if it is none that can stand alone."""
    if word is None:
        return -1
    text, start = source.find(word.start)
    return len(text.text[text.text.rfind("\n", 0, start) + 1 : start].expandtabs())


def _torn(macro: Macro, script: Script, source: Source) -> Iterator[Diagnostic]:
    """A macro that ends with a modifier, where a blank line parts it from the motion below."""
    last = macro.body[-1] if macro.body else None
    if last is None or last.word is None or last.word.text not in INSTRUCTIONS:
        return
    definition = INSTRUCTIONS[last.word.text]
    behind = next((s for s in script.statements if s.span.start > last.span.end), None)
    if definition.role is not MODIFIER or behind is None or behind.word is None:
        return
    text, end = source.find(last.span.end)
    between = text.text[end : end + behind.span.start - last.span.end]
    if behind.word.text in definition.fits and not between.strip():
        yield Diagnostic(
            code="macro-ends-early",
            message=f"macro {quoted(macro.name.text)} ends with `{last.word.text}`, and the motion is not in it",
            primary=Label(span=last.word.span),
            secondary=(Label(span=behind.word.span, text="this is behind the macro"),),
            help="a blank line ends a macro: leave it out, or put a comment between the two",
        )
