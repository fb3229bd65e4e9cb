"""What is written and never used: labels, positions, macros."""

from collections.abc import Iterator

from handeye.al.definition import Refers
from handeye.al.names import all_statements, uses
from handeye.al.syntax import Name, Script, Statement
from handeye.diagnostics import Diagnostic, Label, quoted

_WRITTEN = {
    "TRANS": ("position", (Refers.POSITION, Refers.TARGET)),
    "VECT": ("vector", (Refers.VECTOR,)),
}
"""What an instruction declares, and as what it is used."""


def check_unused(script: Script) -> Iterator[Diagnostic]:
    """A warning for each; of a script without mistakes. Taught positions may be there for another script."""
    statements = list(all_statements(script))
    used: dict[Refers, set[str]] = {refers: set() for refers in Refers}
    for use, refers in uses(statements):
        used[refers].add(use.text)
    yield from _labels(statements, used[Refers.LABEL])
    for op, (what, as_) in _WRITTEN.items():
        yield from _declared(statements, op, what, set().union(*(used[refers] for refers in as_)))
    called = {statement.word.text for statement in statements if statement.word is not None}
    for name, macro in script.macros.items():
        if name not in called:
            yield _unused("unused-macro", macro.name, f"macro {quoted(name)} is never used")


def _labels(statements: list[Statement], used: set[str]) -> Iterator[Diagnostic]:
    for statement in statements:
        for label in statement.labels:
            if label.text not in used:
                message = f"no instruction goes to label {quoted(label.text)}"
                yield _unused("unused-label", label, message)


def _declared(statements: list[Statement], op: str, what: str, used: set[str]) -> Iterator[Diagnostic]:
    for statement in statements:
        if statement.word is not None and statement.word.text == op:
            name = statement.operands[0]
            if isinstance(name, Name) and name.text not in used:
                yield _unused(f"unused-{what}", name, f"{what} {quoted(name.text)} is written and never used")


def _unused(code: str, name: Name, message: str) -> Diagnostic:
    return Diagnostic(code=code, message=message, primary=Label(span=name.span))
