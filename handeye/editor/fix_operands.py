"""Fixes that change marks, names or numbers within a line."""

from collections.abc import Iterator
from typing import Final

from handeye.al.instructions import INSTRUCTIONS
from handeye.al.scanner import TokenKind
from handeye.al.syntax import Name, Text
from handeye.core.diagnostics import Diagnostic, MissingMark, quoted
from handeye.core.source import Span
from handeye.editor.completion import names
from handeye.editor.document import Document
from handeye.editor.fix import Fix, insert, line_of, operand_of, replace, with_blanks_before
from handeye.editor.macro_bodies import called
from handeye.editor.navigation import Edit
from handeye.editor.places import expected, instruction, places

MAX_CHOICES: Final = 8  # for a missing name


def colon(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    if isinstance(diagnostic.meant, MissingMark):
        span, mark = diagnostic.primary.span, diagnostic.meant.mark
        word = document.text[span.start : span.end]
        yield insert(span.end, mark, f"turn {quoted(word)} into the label {quoted(word + mark)}")


def instruction_alone(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    typed, *rest = line_of(document, diagnostic).split()[1]
    if rest and rest[0].text.upper() in INSTRUCTIONS:
        yield replace(Span(start=typed.start, end=rest[0].start), "", f"remove {quoted(typed.text)}")


def close_string(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    line = line_of(document, diagnostic)
    text = document.text[diagnostic.primary.span.start : line.end]
    comment = text.find(" ;")
    words = text if comment < 0 else text[:comment]
    yield insert(diagnostic.primary.span.start + len(words.rstrip()), '"', "close the string")


def close_vector(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    definition, tokens = instruction(line_of(document, diagnostic))
    if definition is None:
        return
    numbers = [p for p in places(definition, tokens[1:]) if p.token.start > diagnostic.primary.span.start]
    operand = numbers[0].operand if numbers else None
    if operand is not None and operand.units:
        last = numbers[: len(operand.units)][-1]
        yield insert(last.token.end, "]", "close the vector")


def hold(_: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    for look in diagnostic.secondary:
        yield insert(look.span.end, " HOLD", "take the picture with `HOLD`")


def end_macro(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    first = document.source.position(diagnostic.primary.span.start)[0]
    for line in document.lines[first:]:
        if line.tokens and line.split()[1][:1] and line.split()[1][0].text.upper() == "DEFINE":
            yield insert(line.start, "\n", "end the macro with a blank line")
            return
    end = "\n" if document.text.endswith("\n") else "\n\n"
    yield insert(len(document.text), end, "end the macro with a blank line")


def remove_parameter(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    """Yield a fix that removes a parameter of a macro, and the parameter's operand in each call of the macro. There is
    no fix if commas separate the operands.
    """
    name = document.name_at(diagnostic.primary.span.start)
    macro = None if name is None else document.macros.get(name.scope)
    if name is None or macro is None:
        return
    spans, lines = [name.span], [line_of(document, diagnostic)]
    for line in document.lines:
        call = called(line, document.macros)
        if call is not None and call.op == name.scope:
            lines.append(line)
            given = [
                p.token
                for p in places(call, line.split()[1][1:])
                if p.operand and p.operand.name == name.name
            ]
            spans += [Span(start=given[0].start, end=given[-1].end)] if given else []
    if not any(token.text == "," for line in lines for token in line.tokens):
        edits = tuple(Edit(span=with_blanks_before(document, span), text="") for span in spans)
        yield Fix(title=f"remove the parameter {quoted(name.name)}", edits=edits)


def drop_operands(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    yield replace(with_blanks_before(document, diagnostic.primary.span), "", "remove the extra operands")


def drop_mark(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    span = diagnostic.primary.span
    mark = document.text[span.start : span.end]
    if mark == ",":
        yield replace(span, " ", "insert a space")
    else:
        yield replace(with_blanks_before(document, span), "", f"remove {quoted(mark)}")


def quote(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    line = line_of(document, diagnostic)
    operand, _ = operand_of(line, diagnostic)
    if operand is not None and operand.takes == (Text,):
        span = Span(start=diagnostic.primary.span.start, end=line.tokens[-1].end)
        words = document.text[span.start : span.end]
        if '"' not in words:
            yield replace(span, f'"{words}"', "put it in quotes")


def fill_in(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    definition, tokens = instruction(line_of(document, diagnostic))
    if definition is None:
        return
    wanted = expected(definition, tokens[1:])
    if len(wanted) == 1 and Name in wanted[0].takes:
        for name in list(names(document, wanted[0].refers.value))[:MAX_CHOICES]:
            yield insert(diagnostic.primary.span.end, f" {name}", f"name {quoted(name)}")


def nearest_number(document: Document, diagnostic: Diagnostic) -> Iterator[Fix]:
    operand, token = operand_of(line_of(document, diagnostic), diagnostic)
    if operand is None or token is None or token.kind is not TokenKind.NUMBER:
        return
    value = float(token.text)
    for choice in sorted(operand.choices, key=lambda c: abs(c - value)):
        yield replace(token.span, f"{choice:g}", f"change to {choice:g}")
    nearest = min(max(value, operand.low), operand.high)
    if nearest != value:
        yield replace(token.span, f"{nearest:g}", f"change to {nearest:g}")
