"""Cures: for a diagnostic whose cure is known, the edits that bring it about.

Most are told by the diagnostic itself, in its help and its labels; so new diagnostics in the same words get theirs.
"""

import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from itertools import count
from typing import Final

from handeye.al.instructions import Operand, Role
from handeye.al.scanner import Kind, Line, Token
from handeye.al.syntax import Name, Text, Vector
from handeye.diagnostics import Diagnostic, quoted
from handeye.editor.completion import names
from handeye.editor.document import Document
from handeye.editor.navigation import Edit
from handeye.editor.occurrences import LABEL, MACRO
from handeye.editor.places import expected, instruction, places
from handeye.source import Span

MOST: Final = 8
"""Choices offered for a name that is missing."""
_DID_YOU_MEAN: Final = re.compile(r"did you mean `(.+?)`\?")
_KNOWN: Final = re.compile(r"known: (`.+`)$")
_COLON: Final = re.compile(r"`(\w+):`")


@dataclass(frozen=True, slots=True, kw_only=True)
class Fix:
    """A cure; the first of several is the likeliest."""

    title: str
    edits: tuple[Edit, ...]


def fixes(document: Document, diagnostic: Diagnostic) -> list[Fix]:
    """The cures of a diagnostic of the document; none if none is known."""
    cure = _CURES.get(diagnostic.code)
    if cure is None and diagnostic.code.startswith("unused-"):
        cure = _remove_unused
    found = [*_suggested(diagnostic), *(cure(document, diagnostic) if cure is not None else ())]
    return list(dict.fromkeys(found))


def _suggested(diagnostic: Diagnostic) -> Iterator[Fix]:
    help, span = diagnostic.help or "", diagnostic.primary.span
    for name in _DID_YOU_MEAN.findall(help):
        yield _replace(span, name, f"change to {quoted(name)}")
    if known := _KNOWN.search(help):
        for name in re.findall(r"`(.+?)`", known[1]):
            yield _replace(span, name, f"change to {quoted(name)}")


def _replace(span: Span, text: str, title: str) -> Fix:
    return Fix(title=title, edits=(Edit(span=span, text=text),))


def _insert(at: int, text: str, title: str) -> Fix:
    return _replace(Span(start=at, end=at), text, title)


# --- marks that are missing, or too many ---------------------------------------------------------


def _colon(_: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    if diagnostic.help and (label := _COLON.search(diagnostic.help)):
        yield _insert(diagnostic.primary.span.end, ":", f"make it the label {quoted(label[1] + ':')}")


def _close_string(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    line = _line(document, diagnostic)
    text = document.text[diagnostic.primary.span.start : line.end]
    comment = text.find(" ;")
    words = text if comment < 0 else text[:comment]
    yield _insert(diagnostic.primary.span.start + len(words.rstrip()), '"', "close the string")


def _close_vector(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    definition, tokens = instruction(_line(document, diagnostic))
    if definition is None:
        return
    numbers = [p for p in places(definition, tokens[1:]) if p.token.start > diagnostic.primary.span.start]
    operand = numbers[0].operand if numbers else None
    if operand is not None:
        inside = numbers[: len(operand.units)]
        yield _insert(inside[-1].token.end, "]", "close the vector")


def _end_macro(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    first = document.source.position(diagnostic.primary.span.start)[0]
    for line in document.lines[first:]:
        if line.tokens and line.split()[1][:1] and line.split()[1][0].text.upper() == "DEFINE":
            yield _insert(line.start, "\n", "end the macro with a blank line")
            return
    end = "\n" if document.text.endswith("\n") else "\n\n"
    yield _insert(len(document.text), end, "end the macro with a blank line")


def _drop_operands(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    yield _replace(_with_blanks_before(document, diagnostic.primary.span), "", "remove what is too much")


def _drop_mark(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    span = diagnostic.primary.span
    mark = document.text[span.start : span.end]
    if mark == ",":
        yield _replace(span, " ", "separate by a blank")
    else:
        yield _replace(_with_blanks_before(document, span), "", f"remove {quoted(mark)}")


def _quote(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    line = _line(document, diagnostic)
    operand, _ = _operand(line, diagnostic)
    if operand is not None and operand.takes == (Text,):
        span = Span(start=diagnostic.primary.span.start, end=line.tokens[-1].end)
        words = document.text[span.start : span.end]
        if '"' not in words:
            yield _replace(span, f'"{words}"', "put it in quotes")


# --- names and numbers ---------------------------------------------------------------------------


def _fill_in(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    definition, tokens = instruction(_line(document, diagnostic))
    if definition is None:
        return
    wanted = expected(definition, tokens[1:])
    if len(wanted) == 1 and Name in wanted[0].takes:
        for name in list(names(document, wanted[0].refers.value))[:MOST]:
            yield _insert(diagnostic.primary.span.end, f" {name}", f"name {quoted(name)}")


def _nearest_number(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    operand, token = _operand(_line(document, diagnostic), diagnostic)
    if operand is None or token is None or token.kind is not Kind.NUMBER:
        return
    value = float(token.text)
    for choice in sorted(operand.choices, key=lambda c: abs(c - value)):
        yield _replace(token_span(token), f"{choice:g}", f"change to {choice:g}")
    nearest = min(max(value, operand.low), operand.high)
    if nearest != value:
        yield _replace(token_span(token), f"{nearest:g}", f"change to {nearest:g}")


# --- lines ---------------------------------------------------------------------------------------


def _remove_line(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    line = _line(document, diagnostic)
    heads, tokens = line.split()
    if heads and tokens:
        word = f"remove `{tokens[0].text}`"
        end = line.end if line.comment is None else tokens[-1].end
        yield _replace(Span(start=tokens[0].start, end=end), "", word)
    else:
        yield _replace(document.whole_line(line.number), "", "remove the line")


def _remove_unused(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    span = diagnostic.primary.span
    name = document.name_at(span.start)
    if name is not None and name.makes and name.kind == LABEL:
        yield from _remove_label(document, name.span)
    elif name is not None and name.makes and name.kind == MACRO:
        first = _line(document, diagnostic).number
        last = first
        while last < len(document.lines) and not document.lines[last].is_blank:
            last += 1
        whole = Span(start=document.whole_line(first).start, end=document.whole_line(last + 1).end)
        yield _replace(whole, "", f"remove the macro {quoted(name.name)}")
    else:
        yield from _remove_line(document, diagnostic)


def _remove_label(document: Document, span: Span) -> Iterator[Fix]:
    line = document.line_at(span.start)
    assert line is not None
    title = f"remove the label {quoted(document.text[span.start : span.end])}"
    if len(line.tokens) == 2 and line.comment is None:
        yield _replace(document.whole_line(line.number), "", title)
        return
    end = span.end + len(document.text[span.end :].split(":", 1)[0]) + 1
    # What followed the label stays in its column.
    fill = " " * (end - span.start) if line.tokens[0].start == span.start else ""
    yield _replace(Span(start=span.start, end=end), fill, title)


def _label_first(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    if not diagnostic.secondary:
        return
    label = document.text[diagnostic.primary.span.start : diagnostic.primary.span.end]
    modifier = document.line_at(diagnostic.secondary[0].span.start)
    assert modifier is not None
    for removed in _remove_label(document, diagnostic.primary.span):
        put = Edit(span=Span(start=modifier.start, end=modifier.start), text=f"{label}:\n")
        yield Fix(title=f"put the label before `{_word(modifier)}`", edits=(put, *removed.edits))


def _jump_over(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    """SKIPE n, modifier, motion: SKIPN n, JUMP behind, modifier, motion, and the label behind."""
    line = _line(document, diagnostic)
    word = document.text[diagnostic.primary.span.start : diagnostic.primary.span.end].upper()
    opposite = {"SKIPE": "SKIPN", "SKIPN": "SKIPE"}[word]
    behind = _behind_motion(document, line.number)
    if behind is None:
        return
    labels = names(document, LABEL)
    label = next(f"PAST{n}" for n in count(1) if f"PAST{n}" not in labels)
    yield Fix(
        title=f"jump over both with `{opposite}` and `JUMP`",
        edits=(
            Edit(span=diagnostic.primary.span, text=opposite),
            Edit(span=_at(document.whole_line(line.number).end), text=f"        JUMP    {label}\n"),
            Edit(span=_at(behind), text=f"{label}:\n" if behind < len(document.text) else f"\n{label}:\n"),
        ),
    )


def _behind_motion(document: Document, number: int) -> int | None:
    """Where the line behind the next motion, and its RESTOREs, begins."""
    moved = False
    for line in document.lines[number:]:
        definition, _ = instruction(line)
        role = None if definition is None else definition.role
        if moved and line.tokens and role is not Role.SHIFT:
            return line.start
        moved = moved or role is Role.MOTION
    return len(document.text) if moved else None


# --- places --------------------------------------------------------------------------------------


def token_span(token: Token) -> Span:
    """Where a token stands."""
    return Span(start=token.start, end=token.end)


def _at(offset: int) -> Span:
    return Span(start=offset, end=offset)


def _line(document: Document, diagnostic: Diagnostic) -> Line:
    line = document.line_at(diagnostic.primary.span.start)
    assert line is not None
    return line


def _word(line: Line) -> str:
    return line.split()[1][0].text.upper()


def _operand(line: Line, diagnostic: Diagnostic) -> tuple[Operand | None, Token | None]:
    definition, tokens = instruction(line)
    if definition is not None:
        for place in places(definition, tokens[1:]):
            if place.token.start == diagnostic.primary.span.start:
                single = place.operand is None or Vector not in place.operand.takes or place.token.text != "["
                return place.operand, place.token if single else None
    return None, None


def _with_blanks_before(document: Document, span: Span) -> Span:
    start = span.start
    while start and document.text[start - 1] in " \t":
        start -= 1
    return Span(start=start, end=span.end)


_CURES: Final[dict[str, Callable[[Document, Diagnostic], Iterator[Fix]]]] = {
    "label-splits-modifier": _label_first,
    "missing-operand": _fill_in,
    "modifier-misplaced": _remove_line,
    "modifier-twice": _remove_line,
    "modifier-without-motion": _remove_line,
    "never-saved": _remove_line,
    "number-out-of-range": _nearest_number,
    "restore-without-move": _remove_line,
    "skip-at-end": _remove_line,
    "skip-over-modifier": _jump_over,
    "too-many-operands": _drop_operands,
    "unexpected-character": _drop_mark,
    "unknown-instruction": _colon,
    "unknown-lens": _nearest_number,
    "unreachable-code": _remove_line,
    "unterminated-macro": _end_macro,
    "unterminated-string": _close_string,
    "unterminated-vector": _close_vector,
    "wrong-operand": _quote,
}
"""What cures a diagnostic, beside what its help suggests."""
