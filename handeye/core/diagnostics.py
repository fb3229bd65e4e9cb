"""Diagnostics: each describes one mistake in a user's text, with its place, and can be shown in a code frame.

A mistake in a text is never an exception: checkers collect `Diagnostic` values, and callers print them or convert
them to JSON.
"""

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Final, NamedTuple

from handeye.core.codes import CODES, Severity
from handeye.core.plain_text import shown
from handeye.core.record import Record
from handeye.core.source import Source, Span

LIMIT: Final = 20  # diagnostics per text


@dataclass(frozen=True, slots=True, kw_only=True)
class Label:
    """A span within one line of a text, with a note to show beside it. The note may be empty."""

    span: Span
    text: str = ""


class SimilarName(Record, frozen=True):
    """Suggestion for an unknown name: a similar known name."""

    name: str


class KnownNames(Record, frozen=True):
    """Suggestion for an unknown name: all known names, if they are few and none is similar."""

    names: tuple[str, ...]


class MissingMark(Record, frozen=True):
    """Suggestion: the punctuation mark that is missing after a word."""

    mark: str


Meant = SimilarName | KnownNames | MissingMark  # what was probably meant; tools can insert it


@dataclass(frozen=True, slots=True, kw_only=True)
class Diagnostic:
    """One mistake in a text. `message` is one lower-case sentence that can be understood without the code frame.
    `meant` is the text that should replace the primary span, if known.
    """

    code: str
    message: str
    primary: Label
    secondary: tuple[Label, ...] = ()
    notes: tuple[str, ...] = ()
    help: str | None = None
    meant: Meant | None = None
    own: Severity | None = None  # severity of a system's own code; None for one of `CODES`

    def __post_init__(self) -> None:
        assert self.own or self.code in CODES, self.code

    @property
    def severity(self) -> Severity:
        """`error` or `warning`: the value of `own` if `own` is set; if not, the severity of the code."""
        return self.own or CODES[self.code].severity


def problem(
    code: str,
    message: str,
    span: Span,
    *secondary: Label,
    text: str = "",
    notes: tuple[str, ...] = (),
    help: str | None = None,
    meant: Meant | None = None,
    own: Severity | None = None,
) -> Diagnostic:
    """Make a diagnostic for a span. `text` is shown next to the mark."""
    primary = Label(span=span, text=text)
    return Diagnostic(
        code=code, message=message, primary=primary, secondary=secondary, notes=notes, help=help, meant=meant,
        own=own,
    )  # fmt: skip


def has_errors(diagnostics: Iterable[Diagnostic]) -> bool:
    return any(d.severity == "error" for d in diagnostics)


def arranged(diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
    """Sort diagnostics by position, drop duplicates, and keep at most `LIMIT`. Warnings are dropped before errors."""
    once = {(d.code, d.primary.span): d for d in diagnostics}
    kept = sorted(once.values(), key=lambda d: (d.severity != "error", d.primary.span))[:LIMIT]
    return sorted(kept, key=lambda d: (d.primary.span, d.code))


def as_json(diagnostic: Diagnostic, source: Source) -> dict[str, object]:
    """Convert a diagnostic to plain data. Lines and columns count from 1; `end` is exclusive."""

    def place(label: Label) -> dict[str, object]:
        text, offset = source.find(label.span.start)
        line, column = text.position(offset)
        end = column + label.span.end - label.span.start
        return {"file": text.name, "line": line, "column": column, "end": end, "text": label.text}

    return {
        "code": diagnostic.code,
        "severity": diagnostic.severity,
        "message": diagnostic.message,
        "file": source.find(diagnostic.primary.span.start)[0].name,
        "primary": place(diagnostic.primary),
        "secondary": [place(label) for label in diagnostic.secondary],
        "notes": list(diagnostic.notes),
        "help": diagnostic.help,
    }


# --- names ---------------------------------------------------------------------------------------


LOOKALIKES: Final = str.maketrans("OoIl", "0011")  # letters to digits
MAX_LISTED: Final = 8  # known names
MOST_COMPARED: Final = 500
LONGEST_COMPARED: Final = 40  # characters; the time of the search grows with their square


def quoted(name: str) -> str:
    """Quote a word of the user's text for a sentence. The word is put in backquotes and shortened to 40 characters,
    and its control characters are shown as symbols.
    """
    short = name if len(name) <= 40 else name[:39] + "…"
    return f"`{_visible(short)[0]}`"


def alternatives(name: str, known: Iterable[str]) -> SimilarName | KnownNames | None:
    """Suggest the nearest known name, at an edit distance of at most a third of the length of `name`. If no name is
    near enough, return all known names if there are only a few, and None if there are many.
    """
    choices = sorted(set(known))
    if _too_many(name, choices):
        return None
    if near := nearest(name, choices, len(name) // 3):
        return SimilarName(near)
    return KnownNames(tuple(choices)) if 0 < len(choices) <= MAX_LISTED else None


def suggestion(name: str, known: Iterable[str]) -> str | None:
    """Write a hint for an unknown name: `did you mean ...?` or `known: ...`. Returns None if no known name is similar,
    and there are too many known names to list.
    """
    return names_sentence(alternatives(name, known))


def names_sentence(names: SimilarName | KnownNames | None) -> str | None:
    """Write a suggestion as a sentence."""
    match names:
        case SimilarName(name):
            return f"did you mean {quoted(name)}?"
        case KnownNames(choices):
            return "known: " + ", ".join(map(quoted, choices))
    return None


def nearest(name: str, known: Iterable[str], farthest: int) -> str | None:
    """Find a known name that looks the same as `name`. If no known name does, find the known name at the least edit
    distance from `name`, or return None if this distance is greater than `farthest`.
    """
    choices = sorted(set(known))
    if _too_many(name, choices):
        return None
    looks = name.translate(LOOKALIKES)
    if same := next((choice for choice in choices if choice.translate(LOOKALIKES) == looks), None):
        return same
    ranked = [(_distance(name.upper(), choice.upper(), farthest), choice) for choice in choices]
    changes, near = min(ranked, default=(farthest + 1, ""))
    return near if changes <= farthest else None


def _too_many(name: str, choices: Sequence[str]) -> bool:
    return len(choices) > MOST_COMPARED or len(name) > LONGEST_COMPARED


def _distance(a: str, b: str, farthest: int) -> int:
    """Return the edit distance between two words. Swapping two neighbouring characters counts as one edit
    (Damerau-Levenshtein). A distance greater than `farthest` may be returned as any number greater than `farthest`.
    """
    if abs(len(a) - len(b)) > farthest:
        return farthest + 1
    before: list[int] = []
    row = list(range(len(b) + 1))
    for i, x in enumerate(a, 1):
        two, before, row = before, row, [i]
        for j, y in enumerate(b, 1):
            best = min(before[j] + 1, row[j - 1] + 1, before[j - 1] + (x != y))
            if i > 1 and j > 1 and x == b[j - 2] and y == a[i - 2]:
                best = min(best, two[j - 2] + 1)
            row.append(best)
    return row[-1]


# --- code frames ---------------------------------------------------------------------------------

WIDTH: Final = 110  # characters of a source line in a frame


def render(diagnostic: Diagnostic, source: Source) -> str:
    """Show a diagnostic with its code frame, without a final newline. Marks in other files follow the marks in the
    primary file.
    """
    texts: dict[str, tuple[Source, list[_Mark]]] = {}
    for label, mark in ((diagnostic.primary, "^"), *((s, "-") for s in diagnostic.secondary)):
        text, start = source.find(label.span.start)
        line, column = text.position(start)
        marked = _Mark(line, column - 1, label.span.end - label.span.start, mark, label.text)
        texts.setdefault(text.key, (text, []))[1].append(marked)
    pad = " " * len(str(max(mark.line for _, marks in texts.values() for mark in marks)))
    out = [f"{diagnostic.severity}[{diagnostic.code}]: {diagnostic.message}"]
    for number, (text, marks) in enumerate(texts.values()):
        corner, name = "├" if number else "┌", _visible(text.name)[0]
        out += [f"{pad}{corner}─ {name}:{marks[0].line}:{marks[0].column + 1}", f"{pad}│"]
        out += _lines(text, marks, pad)
    out.extend(f"{pad}= note: {_visible(note)[0]}" for note in diagnostic.notes)
    if diagnostic.help is not None:
        out.append(f"{pad}= help: {diagnostic.help}")
    return "\n".join(out)


class _Mark(NamedTuple):
    """Characters of a line to mark, counted from 0, and the text to show beside them."""

    line: int
    column: int
    length: int
    mark: str
    text: str


def _lines(source: Source, marks: Sequence[_Mark], pad: str) -> Iterator[str]:
    previous = None
    for number in sorted({mark.line for mark in marks}):
        if previous is not None and number > previous + 1:
            yield f"{pad}·"
        text, rows = _frame(source.line(number), [mark for mark in marks if mark.line == number])
        yield f"{number:>{len(pad)}}│ {text}".rstrip()
        yield from (f"{pad}│ {row}" for row in rows)
        previous = number


def visible(text: str) -> str:
    """Make a text safe for a terminal: control characters are shown as symbols."""
    return "\n".join(_visible(line)[0] for line in text.split("\n"))


def _visible(text: str) -> tuple[str, list[int]]:
    """Expand the tabs of a line and show its control characters as symbols. Returns the line, and the column of
    each character offset.
    """
    line, columns = "", []
    for character in text:
        columns.append(len(line))
        if character == "\t":
            line += " " * (8 - len(line) % 8)
        elif character < " ":
            line += chr(0x2400 + ord(character))
        else:
            line += shown(character)
    columns.append(len(line))
    return line, columns


def _frame(line: str, labels: Sequence[_Mark]) -> tuple[str, list[str]]:
    """Cut a source line to the width of the frame. Returns the line, and the rows of marks and texts to show below
    it.
    """
    shown, columns = _visible(line)
    marks = []
    for label in labels:
        start = min(label.column, len(columns) - 1)
        end = min(start + label.length, len(columns) - 1)
        marks.append((columns[start], max(columns[end], columns[start] + 1), label.mark, label.text))
    marks.sort(key=lambda m: (m[0], m[2] == "^"))
    cut = max(0, marks[0][0] - WIDTH // 2) if len(shown) > WIDTH else 0
    text = ("…" if cut else "") + shown[cut : cut + WIDTH] + ("…" if len(shown) > cut + WIDTH else "")
    shift = cut - (1 if cut else 0)
    return text, _rows(
        [(a - shift, min(b - shift, WIDTH + 2), m, t) for a, b, m, t in marks if a - shift <= WIDTH]
    )


def _rows(marks: list[tuple[int, int, str, str]]) -> list[str]:
    """Build the rows below a line. The first row has all marks, and the text of the last mark beside them. The next
    rows have the texts of the other marks, joined to these marks by vertical bars.
    """
    under = [" "] * max(end for _, end, _, _ in marks)
    for start, end, mark, _ in sorted(marks, key=lambda m: m[2] == "^"):
        under[start:end] = mark * (end - start)
    rows = ["".join(under) + (f" {marks[-1][3]}" if marks[-1][3] else "")]
    below = [(start, text) for start, _, _, text in marks[:-1] if text]
    if below:
        rows.append(_stems([start for start, _ in below]))
    while below:
        start, text = below.pop()
        rows.append(_stems([s for s, _ in below]).ljust(start) + text)
    return rows


def _stems(columns: Sequence[int]) -> str:
    row = ""
    for column in columns:
        row = row.ljust(column) + "|" if column >= len(row) else row
    return row
