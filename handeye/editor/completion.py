"""Proposes completions for the next word."""

from collections.abc import Iterator
from dataclasses import dataclass

from handeye.al.definition import AXES, NIL, Operand, Refers
from handeye.al.instructions import EXPLAINED
from handeye.al.scanner import TokenKind, scan
from handeye.al.syntax import Name
from handeye.core.errors import ERRORS
from handeye.core.source import Span, line_name
from handeye.editor.document import Document
from handeye.editor.macro_bodies import called, uses
from handeye.editor.occurrences import MACRO, PARAMETER, PART, POSITION
from handeye.editor.places import expected, instruction


@dataclass(frozen=True, slots=True, kw_only=True)
class Proposal:
    """A proposed word. `kind` is `instruction`, `word`, `number`, or the kind of a name."""

    text: str
    kind: str
    detail: str
    help: str = ""


def completions(document: Document, offset: int) -> tuple[Span, list[Proposal]]:
    """Return the words that are proposed at an offset, and the span of text that such a word would replace."""
    number, column = document.source.position(offset)
    start = offset - column + 1
    before = document.source.line(number)[: column - 1]
    word = _word_before(before)
    span = Span(start=offset - len(word), end=offset)
    line = scan(before[: len(before) - len(word)] + "\n")[0]
    whole = scan(before + "\n")[0].tokens
    in_string = whole and whole[-1].kind is TokenKind.STRING and before.endswith(whole[-1].text)
    if line.comment is not None or in_string or start < 0:
        return span, []
    definition, tokens = instruction(line)
    if not tokens:
        known = (
            Proposal(text=i.op, kind="instruction", detail=i.usage, help=i.help) for i in EXPLAINED.values()
        )
        return span, [*known, *_named(document, MACRO)]
    usage = definition or called(line, document.macros)
    wanted = expected(usage, tokens[1:]) if usage is not None else []
    macro = document.macro_at(start) if wanted else None
    found = (
        []
        if macro is None
        else [
            Proposal(text=token.text, kind=PARAMETER, detail=f"parameter of {macro.head.word}")
            for token in macro.head.parameters
        ]
    )
    last = tokens[-1].text.upper()
    for operand in wanted:
        stands = [operand]
        if definition is None and usage is not None:
            stands = [use.operand for use in uses(document.macros, usage.op, operand.name)]
        found += [proposal for each in stands for proposal in _operand(document, each, after=last)]
    return span, list(dict.fromkeys(found))


def names(document: Document, kind: str) -> dict[str, str]:
    """Return the names of one kind, each with its origin."""
    found = dict.fromkeys(document.taught_of(kind), f"taught {kind}")
    for name in document.names:
        if name.kind == kind and name.makes:
            found.setdefault(name.name, f"{kind}, line {document.source.position(name.span.start)[0]}")
    for text, name in document.required_names:
        if name.kind == kind and name.makes:
            line = line_name(text.position(name.span.start)[0], text.key)
            found.setdefault(name.name, f"{kind}, line {line}")
    return dict(sorted(found.items()))


def _word_before(text: str) -> str:
    at = len(text)
    while at and (text[at - 1].isalnum() or text[at - 1] in "_."):
        at -= 1
    return text[at:]


def _operand(document: Document, operand: Operand, *, after: str) -> Iterator[Proposal]:
    if operand.word and after != operand.word:
        yield Proposal(text=operand.word, kind="word", detail=operand.shown)
        return
    if operand.nil:
        yield Proposal(text=NIL, kind="word", detail=f"no {operand.name}")
    if Name in operand.takes and operand.refers is not Refers.NEW:
        kinds = (POSITION, PART) if operand.refers is Refers.TARGET else (operand.refers.value,)
        for kind in kinds:
            yield from _named(document, kind)
        if operand.refers is Refers.VECTOR:
            yield from (Proposal(text=axis, kind="word", detail="axis of the table") for axis in AXES)
    for choice in operand.choices:
        yield Proposal(text=f"{choice:g}", kind="number", detail=f"{choice:g} {operand.units[0].name}")
    if operand.whole and operand.name == "error":
        for number, meaning in ERRORS.items():
            yield Proposal(text=str(number), kind="number", detail=meaning)


def _named(document: Document, kind: str) -> Iterator[Proposal]:
    for name, detail in names(document, kind).items():
        yield Proposal(text=name, kind=kind, detail=detail)
