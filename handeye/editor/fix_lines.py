"""Fixes that remove, move or insert lines."""

from collections.abc import Iterator
from itertools import count, takewhile

from handeye.al.definition import Role
from handeye.core.diagnostics import Diagnostic, quoted
from handeye.core.source import Span
from handeye.editor.completion import names
from handeye.editor.document import Document
from handeye.editor.fix import Fix, at, insert, line_of, replace, word_of
from handeye.editor.navigation import Edit
from handeye.editor.occurrences import LABEL, MACRO
from handeye.editor.places import instruction


def remove_line(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    line = line_of(document, diagnostic)
    heads, tokens = line.split()
    if tokens and instruction(line)[0] is None:
        return  # a macro call: removing it would remove more than the mistake
    if heads and tokens:
        word = f"remove `{tokens[0].text}`"
        end = line.end if line.comment is None else tokens[-1].end
        yield replace(Span(start=tokens[0].start, end=end), "", word)
    else:
        yield replace(document.whole_line(line.number), "", "remove the line")


def remove_unused(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    span = diagnostic.primary.span
    name = document.name_at(span.start)
    if name is not None and name.makes and name.kind == LABEL:
        yield from _remove_label(document, name.span)
    elif name is not None and name.makes and name.kind == MACRO:
        first = line_of(document, diagnostic).number
        last = first
        while last < len(document.lines) and not document.lines[last].is_blank:
            last += 1
        whole = Span(start=document.whole_line(first).start, end=document.whole_line(last + 1).end)
        yield replace(whole, "", f"remove the macro {quoted(name.name)}")
    else:
        yield from remove_line(document, diagnostic)


def _remove_label(document: Document, span: Span) -> Iterator[Fix]:
    line = document.line_of(span.start)
    title = f"remove the label {quoted(document.text[span.start : span.end])}"
    if len(line.tokens) == 2 and line.comment is None:
        yield replace(document.whole_line(line.number), "", title)
        return
    end = span.end + len(document.text[span.end :].split(":", 1)[0]) + 1
    # What followed the label stays in its column.
    fill = " " * (end - span.start) if line.tokens[0].start == span.start else ""
    yield replace(Span(start=span.start, end=end), fill, title)


def label_first(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    if not diagnostic.secondary:
        return
    label = document.text[diagnostic.primary.span.start : diagnostic.primary.span.end]
    modifier = document.line_of(diagnostic.secondary[0].span.start)
    for removed in _remove_label(document, diagnostic.primary.span):
        put = Edit(span=Span(start=modifier.start, end=modifier.start), text=f"{label}:\n")
        yield Fix(title=f"put the label before `{word_of(modifier)}`", edits=(put, *removed.edits))


def jump_over(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    """Yield a fix that replaces "SKIPE n, modifier, motion" by "SKIPN n, JUMP label, modifier, motion, label"."""
    line = line_of(document, diagnostic)
    word = document.text[diagnostic.primary.span.start : diagnostic.primary.span.end].upper()
    opposite = {"SKIPE": "SKIPN", "SKIPN": "SKIPE"}[word]
    behind = _behind_motion(document, line.number)
    if behind is None:
        return
    labels = names(document, LABEL)
    label = next(f"PAST{n}" for n in count(1) if f"PAST{n}" not in labels)
    yield Fix(
        title=f"use `{opposite}` and `JUMP` to skip the modifier and the motion",
        edits=(
            Edit(span=diagnostic.primary.span, text=opposite),
            Edit(span=at(document.whole_line(line.number).end), text=f"        JUMP    {label}\n"),
            Edit(span=at(behind), text=f"{label}:\n" if behind < len(document.text) else f"\n{label}:\n"),
        ),
    )


def _behind_motion(document: Document, number: int) -> int | None:
    """Return the start of the line after the next motion and its RESTOREs, or None if no motion follows."""
    moved = False
    for line in document.lines[number:]:
        definition, _ = instruction(line)
        role = None if definition is None else definition.role
        if moved and line.tokens and role is not Role.SHIFT:
            return line.start
        moved = moved or role is Role.MOTION
    return len(document.text) if moved else None


def drop_test(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    """Yield a fix that removes a SKIPE if the error that it tests for cannot occur; this SKIPE never skips. A SKIPN
    that tests for an impossible error always skips. It gets no fix, because we do not know what the user intended.
    """
    if word_of(line_of(document, diagnostic)) == "SKIPE":
        yield from remove_line(document, diagnostic)


def close_up(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    """Yield a fix for a macro in which blank lines separate a modifier from its motion. The fix removes the blank
    lines, so that the motion belongs to the macro. There is no fix if the macro would then have no end.
    """
    behind = document.line_of(diagnostic.secondary[0].span.start)
    body = list(takewhile(lambda line: not line.is_blank, document.lines[behind.number :]))
    words = {word_of(line) for line in body if line.split()[1]}
    macros = {name.name for name in document.names if name.kind == MACRO}
    if behind.number + len(body) < len(document.lines) and words.isdisjoint({*macros, "DEFINE"}):
        end = document.whole_line(line_of(document, diagnostic).number).end
        yield replace(Span(start=end, end=behind.start), "", "remove the blank line")


def begin_search(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    """Yield a fix that inserts a SEARCH before the label to which an AOJ jumps. The SEARCH has the search step that
    the program of 1973 used.
    """
    line = line_of(document, diagnostic)
    label = next(
        (n for n in document.names if n.kind == LABEL and line.start <= n.span.start < line.end), None
    )
    made = [n for n in document.names if n.makes and label is not None and n.name == label.name]
    if made:
        before = document.line_of(made[0].span.start)
        yield insert(before.start, "        SEARCH  .07\n", "begin a search with steps of .07 in")
