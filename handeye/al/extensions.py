"""Finds words and operands that handeye adds to the language of the 1970s.

Words from documents that we have not read again, but remember (`docs/sources.md`), do not count as additions.
"""

from collections.abc import Iterator
from functools import partial

from handeye.al.instructions import INSTRUCTIONS
from handeye.al.macros import as_called, expand
from handeye.al.parser import parse_whole
from handeye.al.statements import pairs
from handeye.al.syntax import Number
from handeye.core.diagnostics import Diagnostic, arranged, problem, quoted
from handeye.core.source import Source, Span

_ours = partial(problem, "extension-used")
_AGAINST = "write a vector, as in 1973: `STOP [0 0 -50]`"


def extensions(source: Source) -> list[Diagnostic]:
    """Return an error for each word and operand that handeye adds, including the words and operands in required
    texts.
    """
    return arranged(_found(source))


def _found(source: Source) -> Iterator[Diagnostic]:
    script = parse_whole(source)[0]
    for macro in script.macros.values():
        if macro.parameters:
            span = Span(start=macro.parameters[0].start, end=macro.parameters[-1].end)
            yield _ours(
                "macro parameters are an extension of handeye", span, help="write a macro for each use"
            )
    for statement in as_called(script, expand(script, lambda _: None)):
        definition = INSTRUCTIONS.get(statement.word.text) if statement.word is not None else None
        if statement.word is None or definition is None:
            continue
        if definition.ours:
            yield _ours(f"`{definition.op}` is not documented before 1978", statement.word.span)
            continue
        for operand, value in pairs(statement):
            if value is None:
                continue
            if isinstance(value, Number) and value.value == 0 and operand.name == "speed":
                continue  # the 0 of the dialect of 1977
            if operand.ours:
                message = (
                    f"{quoted(operand.shown.strip('()'))} of `{definition.op}` is an extension of handeye"
                )
                yield _ours(message, value.span)
            elif definition.op == "STOP" and isinstance(value, Number):
                yield _ours("`STOP` with a number is an extension of handeye", value.span, help=_AGAINST)
