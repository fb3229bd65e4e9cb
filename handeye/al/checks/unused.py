"""Check for what is defined but never used: labels, positions, macros."""

import re
from collections.abc import Iterable, Iterator
from dataclasses import replace
from functools import cache, partial

from handeye.al.definition import Refers
from handeye.al.instructions import INSTRUCTIONS
from handeye.al.statements import ByWord, Used, all_statements
from handeye.al.syntax import Name, Script, Statement
from handeye.core.diagnostics import Diagnostic, Label, quoted
from handeye.core.source import Source

_WRITTEN = {
    "TRANS": ("position", (Refers.POSITION, Refers.TARGET)),
    "VECT": ("vector", (Refers.VECTOR,)),
}
"""Kinds of things that an instruction declares, and as what they are used."""
_COMMENTED = re.compile(
    r"""^ (?: [^\n;"] | "[^\n"]*" )* ; [ \t]* (\w+) [ \t]+ (\w+)""", re.ASCII | re.MULTILINE | re.VERBOSE
)
"""A comment that begins with two words."""
_TOO_FAR = ("search-begun-anew", "count-begun-anew")


def check_unused(
    script: Script, statements: Iterable[Statement], words: ByWord, used: Used, source: Source
) -> Iterator[Diagnostic]:
    """A warning for each; of a script without mistakes. Taught positions may be there for another script."""
    gone_to = {name.text for name in used[Refers.LABEL]}
    for statement in statements:
        for label in statement.labels:
            if label.text not in gone_to:
                message = f"no instruction jumps to label {quoted(label.text)}"
                yield _unused("unused-label", label, message)
    for op, (what, as_) in _WRITTEN.items():
        found = {name.text for refers in as_ for name in used[refers]}
        commented = cache(partial(_in_comments, source, as_))
        for statement in words.get(op, ()):
            name = statement.operands[0]
            if isinstance(name, Name) and name.text not in found:
                line = commented().get(name.text)
                help = None if line is None else f"on line {line} it is in a comment, after a `;`"
                message = f"{what} {quoted(name.text)} is defined but never used"
                yield _unused(f"unused-{what}", name, message, help)
    called = {statement.word.text for statement in all_statements(script) if statement.word is not None}
    for word, macro in script.macros.items():
        if word not in called:
            yield _unused("unused-macro", macro.name, f"macro {quoted(word)} is never used")


def with_unused(found: list[Diagnostic], unused: list[Diagnostic]) -> list[Diagnostic]:
    """Both together. A jump back that goes too far, over an unused label, may have meant that: it is one mistake."""
    left, told = list(unused), []
    for diagnostic in found:
        if diagnostic.code in _TOO_FAR:
            begin, end = diagnostic.secondary[0].span.start, diagnostic.primary.span.start
            meant = [d for d in left if d.code == "unused-label" and begin < d.primary.span.start < end]
            if len(meant) == 1:
                left.remove(meant[0])
                label = Label(span=meant[0].primary.span, text="nothing jumps here")
                diagnostic = replace(diagnostic, secondary=(*diagnostic.secondary, label))
        told.append(diagnostic)
    return told + left


def _in_comments(source: Source, refers: tuple[Refers, ...]) -> dict[str, int]:
    """Names that an instruction behind a semicolon would use, and the line it stands on."""
    words = {i.op for i in INSTRUCTIONS.values() if i.operands and i.operands[0].refers in refers}
    found: dict[str, int] = {}
    for comment in _COMMENTED.finditer(source.text):
        if comment[1].upper() in words:
            found.setdefault(comment[2], source.position(comment.start(1))[0])
    return found


def _unused(code: str, name: Name, message: str, help: str | None = None) -> Diagnostic:
    return Diagnostic(code=code, message=message, primary=Label(span=name.span), help=help)
