"""Macros: each call is replaced by the statements of the macro."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Final

import msgspec
from msgspec.structs import replace

from handeye.al.syntax import Name, Script, Statement
from handeye.diagnostics import Diagnostic, Label, quoted

LONGEST: Final = 10_000
"""Statements of the longest program, macros expanded."""
DEEPEST: Final = 20
"""Calls within calls."""

Call = tuple[int, ...]
"""Which call of a macro a statement comes from, within which other call: () is the text itself."""


class Placed(msgspec.Struct, frozen=True, gc=False):
    """A statement at its place in the expanded program; no call of a macro."""

    statement: Statement
    call: Call
    macro: str
    """The macro it stands in; empty: none."""


def expand(script: Script, report: Callable[[Diagnostic], None]) -> list[Placed]:
    """The statements of the program in order; as far as macros can be expanded."""
    expansion = _Expansion(script=script, report=report)
    expansion.place(script.statements, (), ())
    return expansion.placed


@dataclass(slots=True)
class _Expansion:
    script: Script
    report: Callable[[Diagnostic], None]
    placed: list[Placed] = field(default_factory=list)
    visited: int = 0
    too_long: bool = False

    def place(self, statements: tuple[Statement, ...], call: Call, inside: tuple[str, ...]) -> None:
        for statement in statements:
            if self.too_long:
                return
            self.visited += 1
            if self.visited > LONGEST:
                self.stop(statement, f"the program has more than {LONGEST} statements")
            elif statement.word is None or statement.word.text not in self.script.macros or statement.broken:
                self.placed.append(Placed(statement, call, inside[-1] if inside else ""))
            else:
                self.call(statement, statement.word, call, inside)

    def call(self, statement: Statement, word: Name, call: Call, inside: tuple[str, ...]) -> None:
        if word.text in inside:
            self.problem("recursive-macro", statement, f"macro {quoted(word.text)} uses itself")
            return
        if len(inside) >= DEEPEST:
            self.stop(statement, f"macros are nested more than {DEEPEST} deep")
            return
        if statement.labels:
            self.placed.append(Placed(replace(statement, word=None), call, inside[-1] if inside else ""))
        body = self.script.macros[word.text].body
        self.place(body, (*call, self.visited), (*inside, word.text))

    def stop(self, statement: Statement, message: str) -> None:
        self.too_long = True
        self.problem("program-too-long", statement, message)

    def problem(self, code: str, statement: Statement, message: str) -> None:
        self.report(Diagnostic(code=code, message=message, primary=Label(span=statement.span)))
