"""What is wrong with a user's text, said once, with the place, and shown in a code frame.

A wrong text is never an exception: checkers collect `Diagnostic`s, callers render or serialise them.
"""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from typing import Final, Literal

from handeye.source import Source, Span

Severity = Literal["error", "warning"]
LIMIT: Final = 20
"""At most so many diagnostics for one text: nobody reads more."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Code:
    """What a kind of diagnostic means; `example` is a text that gets it."""

    severity: Severity
    meaning: str
    example: str
    phase: Literal["language", "planning", "strict"] = "language"


def _error(meaning: str, example: str) -> Code:
    return Code(severity="error", meaning=meaning, example=example)


def _warning(meaning: str, example: str) -> Code:
    return Code(severity="warning", meaning=meaning, example=example)


def _planning(meaning: str, example: str) -> Code:
    return Code(severity="error", meaning=meaning, example=example, phase="planning")


CODES: Final[dict[str, Code]] = {
    "aoj-without-search": _warning("no SEARCH comes before an AOJ on any way to it", "L: MOVE T\nAOJ L"),
    "axis-count": _error("a FREE or SPIN has not as many axes as it says", "FREE 2 X\nCHANGE X 1"),
    "empty-program": _error("there is no instruction to carry out", "; nothing"),
    "endless-loop": _warning(
        "a loop moves the arm, and nothing but an untested error ends it", "L: MOVE T\nJUMP L"
    ),
    "error-never-raised": _warning(
        "a test asks for an error that the action before it does not raise", "OPEN 1\nSKIPE 23\nPARK"
    ),
    "extension-used": Code(
        severity="error",
        meaning="a word or an operand is ours, and the language was to be that of the seventies",
        example="LOAD 4",
        phase="strict",
    ),
    "hand-through-table": _planning("part of the hand would be below the table top", "MOVE LOW"),
    "idle-loop": _warning("nothing leads out of a loop, and nothing moves in it", "PARK\nL: JUMP L"),
    "label-splits-modifier": _error(
        "a label stands between a modifier and its motion, so that a jump would lose the modifier",
        "STOP 50\nL: MOVE T\nJUMP L",
    ),
    "label-twice": _error("two statements have the same label", "L: OPEN 1\nL: OPEN 2"),
    "macro-name-taken": _error("a macro has the name of an instruction", "DEFINE OPEN\nPARK\n\nPARK"),
    "macro-twice": _error("two macros have the same name", "DEFINE A\nPARK\n\nDEFINE A\nPARK\n\nA"),
    "malformed-number": _error("a number is not written as one", "OPEN 1.2.3"),
    "misplaced-comma": _error("a comma does not stand between two operands", "CLOSE .1,"),
    "missing-operand": _error("an instruction lacks an operand", "OPEN"),
    "modifier-misplaced": _error(
        "a modifier stands before a motion it cannot modify", "FORCE [0 0 -9]\nMOVE T"
    ),
    "modifier-twice": _error("a motion has two modifiers where it can have one", "STOP 9\nTORQUE 9\nMOVE T"),
    "modifier-without-motion": _error("a modifier is not followed by a motion", "STOP [0 0 -50]\nOPEN 1"),
    "never-saved": _warning("a difference is restored that no SAVE keeps", "MOVE T\nRESTORE H"),
    "number-out-of-range": _error("a number is too small or too large for its place", "OPEN 5"),
    "position-twice": _error(
        "two positions have the same name", "TRANS A [1 2 3 0 0 0]\nTRANS A [1 2 3 0 0 0]\nPARK"
    ),
    "program-too-long": _error(
        "macros expand to too many statements, or are nested too deeply",
        "\n".join(f"DEFINE M{i}\nM{i + 1}\n" for i in range(25)) + "\nDEFINE M25\nPARK\n\nM0",
    ),
    "recursive-macro": _error("a macro uses itself", "DEFINE A\nOPEN 1\nA\n\nA"),
    "restore-without-move": _error("a RESTORE does not follow a MOVE", "SAVE H\nOPEN 1\nRESTORE H"),
    "save-without-move": _warning("no MOVE comes before a SAVE on any way to it", "CLOSE\nSAVE H"),
    "search-without-aoj": _warning("no AOJ comes after a SEARCH on any way from it", "SEARCH .07\nMOVE T"),
    "skip-at-end": _error("a skip has no instruction after it", "PARK\nSKIPE 23"),
    "skip-over-modifier": _error(
        "a skip would skip a modifier and not its motion", "SKIPE 23\nSTOP [0 0 -50]\nMOVE T"
    ),
    "specific-without-general": _warning(
        "no GENERAL comes before a SPECIFIC on any way to it", "LOOK V\nSPECIFIC BASE V"
    ),
    "spin-stays-stiff": _warning("a SPIN is understood and not carried out", "SPIN 1 X\nCHANGE Z -1"),
    "stop-beyond-arm": _planning(
        "a motion is to stop on a force that the arm cannot exert", "STOP [0 0 -9000]"
    ),
    "test-without-action": _warning(
        "an error is tested where no action comes directly before", "SKIPE 23\nPARK"
    ),
    "too-many-operands": _error("an instruction has more operands than it takes", "OPEN 1 2"),
    "travel-without-change": _warning(
        "no CHANGE comes before a TRAVEL on any way to it", "PARK\nTRAVEL .1 .2"
    ),
    "unexpected-character": _error("a character is no part of the language", "OPEN = 1"),
    "unknown-axis": _error("an axis is none of X, Y and Z", "FREE 1 W\nCHANGE X 1"),
    "unknown-counter": _error("no ASSIGN sets a counter of that name", "L: PARK\nSOJG N L"),
    "unknown-error-number": _warning("an error is tested that nothing raises", "PARK\nSKIPE 42\nPARK\nPARK"),
    "unknown-instruction": _error("a word is neither an instruction nor a macro", "GRAB 1"),
    "unknown-label": _error("a jump goes to a label that no statement has", "JUMP NOWHERE"),
    "unknown-lens": _error("the turret has no such lens", "LENS 35"),
    "unknown-part": _error("a part is not known", "TRANS A [0 0 0 0 0 0] OF LID\nPARK"),
    "unknown-picture": _error("no LOOK takes a picture of that name", "GENERAL BASE VIEW"),
    "unknown-position": _error("a position is neither taught nor written with TRANS", "MOVE X9"),
    "unknown-target": _error("what the camera shall aim at is neither a position nor a part", "AIM X9"),
    "unknown-vector": _error("a vector is neither an axis nor written with VECT", "CHANGE DOWN 1"),
    "unreachable-code": _warning("a statement is never carried out", "JUMP L\nOPEN 1\nL: PARK"),
    "unreachable-position": _planning("a position is out of the arm's reach", "MOVE FAR"),
    "unterminated-macro": _error("a macro is not ended by a blank line", "PARK\nDEFINE A\nOPEN 1"),
    "unterminated-string": _error("a string has no closing quote", 'STAGE "one'),
    "unterminated-vector": _error("a vector has no closing bracket", "CHANGE [0 0 -1 0.6"),
    "unused-label": _warning("no instruction goes to a label", "L: PARK"),
    "unused-macro": _warning("a macro is never used", "PARK\nDEFINE A\nOPEN 1\n\n"),
    "unused-position": _warning("a position is written and never used", "TRANS A [1 2 3 0 0 0]\nPARK"),
    "unused-vector": _warning("a vector is written and never used", "VECT D [0 0 1]\nPARK"),
    "vector-size": _error("a vector has too few or too many numbers", "CHANGE [0 0] 1"),
    "vector-twice": _error(
        "two vectors have the same name, or one has the name of an axis", "VECT Z [0 0 1]\nCHANGE Z 1"
    ),
    "wrong-operand": _error("an operand is of another kind than its place needs", "OPEN T"),
    "zero-vector": _error("a vector that gives a direction has no length", "CHANGE [0 0 0] 1"),
}
"""Every kind of diagnostic there is, by code."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Label:
    """A place in the text, within one line, and what there is to say about it (may be empty)."""

    span: Span
    text: str = ""


@dataclass(frozen=True, slots=True, kw_only=True)
class Diagnostic:
    """One mistake. `message`: one lower-case sentence, true without the frame."""

    code: str
    message: str
    primary: Label
    secondary: tuple[Label, ...] = ()
    notes: tuple[str, ...] = ()
    help: str | None = None

    def __post_init__(self) -> None:
        assert self.code in CODES, self.code

    @property
    def severity(self) -> Severity:
        """`error` or `warning`, by its code."""
        return CODES[self.code].severity


def has_errors(diagnostics: Iterable[Diagnostic]) -> bool:
    """Whether any of them is an error."""
    return any(d.severity == "error" for d in diagnostics)


def arranged(diagnostics: Iterable[Diagnostic]) -> list[Diagnostic]:
    """Each mistake once, by position, at most `LIMIT`; errors are kept before warnings."""
    once = {(d.code, d.primary.span): d for d in diagnostics}
    kept = sorted(once.values(), key=lambda d: (d.severity != "error", d.primary.span))[:LIMIT]
    return sorted(kept, key=lambda d: (d.primary.span, d.code))


def as_json(diagnostic: Diagnostic, source: Source) -> dict[str, object]:
    """The diagnostic as plain data; lines and columns from 1, `end` exclusive."""

    def place(label: Label) -> dict[str, object]:
        line, column = source.position(label.span.start)
        end = column + label.span.end - label.span.start
        return {"line": line, "column": column, "end": end, "text": label.text}

    return {
        "code": diagnostic.code,
        "severity": diagnostic.severity,
        "message": diagnostic.message,
        "file": source.name,
        "primary": place(diagnostic.primary),
        "secondary": [place(label) for label in diagnostic.secondary],
        "notes": list(diagnostic.notes),
        "help": diagnostic.help,
    }


# --- names ---------------------------------------------------------------------------------------


def quoted(name: str) -> str:
    """A word of the user's text inside a sentence: in backquotes, shortened, made visible."""
    short = name if len(name) <= 40 else name[:39] + "…"
    return f"`{_visible(short)[0]}`"


def suggestion(name: str, known: Iterable[str]) -> str | None:
    """`did you mean ...` for the nearest known name, at most a third of its length away; else few choices."""
    choices = sorted(set(known))
    ranked = sorted((_distance(name.upper(), choice.upper()), choice) for choice in choices)
    if ranked and ranked[0][0] <= len(name) // 3:
        return f"did you mean {quoted(ranked[0][1])}?"
    if 0 < len(choices) <= 8:
        return "known: " + ", ".join(map(quoted, choices))
    return None


def _distance(a: str, b: str) -> int:
    """Insertions, deletions, replacements and swaps of neighbours that turn `a` into `b`; far is len(a)."""
    if abs(len(a) - len(b)) > len(a) // 3:
        return len(a) + 1
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

WIDTH: Final = 110
"""Longest piece of a source line a frame shows."""


def render(diagnostic: Diagnostic, source: Source) -> str:
    """The diagnostic with its code frame, for people; no final newline."""
    lines: dict[int, list[tuple[Label, str]]] = {}
    for label, mark in ((diagnostic.primary, "^"), *((s, "-") for s in diagnostic.secondary)):
        lines.setdefault(source.position(label.span.start)[0], []).append((label, mark))
    line, column = source.position(diagnostic.primary.span.start)
    pad = " " * len(str(max(lines)))
    out = [
        f"{diagnostic.severity}[{diagnostic.code}]: {diagnostic.message}",
        f"{pad}┌─ {source.name}:{line}:{column}",
        f"{pad}│",
    ]
    previous = None
    for number in sorted(lines):
        if previous is not None and number > previous + 1:
            out.append(f"{pad}·")
        text, rows = _frame(source, number, lines[number])
        out.append(f"{number:>{len(pad)}}│ {text}".rstrip())
        out.extend(f"{pad}│ {row}" for row in rows)
        previous = number
    out.extend(f"{pad}= note: {note}" for note in diagnostic.notes)
    if diagnostic.help is not None:
        out.append(f"{pad}= help: {diagnostic.help}")
    return "\n".join(out)


def _visible(text: str) -> tuple[str, list[int]]:
    """`text` as a terminal may show it (tabs expanded, control characters as symbols); column by offset."""
    shown, columns = "", []
    for character in text:
        columns.append(len(shown))
        if character == "\t":
            shown += " " * (8 - len(shown) % 8)
        elif character < " ":
            shown += chr(0x2400 + ord(character))
        else:
            shown += character if character.isprintable() else "\N{REPLACEMENT CHARACTER}"
    columns.append(len(shown))
    return shown, columns


def _frame(source: Source, number: int, labels: Sequence[tuple[Label, str]]) -> tuple[str, list[str]]:
    """A source line, cut to a width, and the rows of marks and words under it."""
    shown, columns = _visible(source.line(number))
    marks = []
    for label, mark in labels:
        start = min(source.position(label.span.start)[1] - 1, len(columns) - 1)
        end = min(start + label.span.end - label.span.start, len(columns) - 1)
        marks.append((columns[start], max(columns[end], columns[start] + 1), mark, label.text))
    marks.sort(key=lambda m: (m[0], m[2] == "^"))
    cut = max(0, marks[0][0] - WIDTH // 2) if len(shown) > WIDTH else 0
    text = ("…" if cut else "") + shown[cut : cut + WIDTH] + ("…" if len(shown) > cut + WIDTH else "")
    shift = cut - (1 if cut else 0)
    return text, _rows(
        [(a - shift, min(b - shift, WIDTH + 2), m, t) for a, b, m, t in marks if a - shift < WIDTH]
    )


def _rows(marks: list[tuple[int, int, str, str]]) -> list[str]:
    """Marks under a line; the words of the last stand beside it, those of the others below, on stems."""
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
