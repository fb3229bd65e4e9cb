"""Shows tables as text."""

from collections.abc import Iterator, Sequence
from typing import Any, Final

from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted
from handeye.systems.ml.dashboard.history import Course, History
from handeye.systems.ml.dashboard.layout import Segment, line_labels
from handeye.systems.ml.machine.spec import CYCLES_PER_SECOND

CHANGED: Final = "*"  # written after a word that changed in the cycle


def all_tables(done: History, cycle: int) -> dict[str, Any]:
    """Describe all tables at the end of a cycle, for JSON."""
    tables = [
        {
            "table": segment.table, "arm": segment.side, "title": segment.shape.title, "lines": segment.shape.lines,
            "words": segment.shape.words, "changed": _changing(done, segment), "now": _changing(done, segment, cycle),
        }
        for segment in done.segments
    ]  # fmt: skip
    return {"program": done.head.program, "cycle": cycle, "cycles": done.head.cycles, "tables": tables}


def one_table(done: History, segment: Segment, cycle: int, line: int | None = None) -> dict[str, Any]:
    """Describe a table, or a line of it, at the end of a cycle, for JSON. Unused lines are left out."""
    lines = done.used(segment) if line is None else [_within(line, segment.shape.lines, "line")]
    numbers = {n: range(segment.number(n, 1), segment.number(n, 1) + segment.shape.words) for n in lines}
    return {
        "table": segment.table, "arm": segment.side, "cycle": cycle,
        "names": segment.names,
        "lines": {str(n): [done.value(number, cycle) for number in those] for n, those in numbers.items()},
        "changed": [
            segment.line_word(number) for those in numbers.values() for number in those if done.changed(number, cycle)
        ],
    }  # fmt: skip


def one_word(done: History, segment: Segment, line: int, word: int) -> dict[str, Any]:
    """Describe the changes of a word for JSON. Each change has the cycle and the new value."""
    _within(line, segment.shape.lines, "line")
    _within(word, segment.shape.words, "word")
    found = done.courses.get(segment.number(line, word), Course())
    changes = [*zip(found.cycles, found.values, strict=True)]
    return {"table": segment.table, "arm": segment.side, "line": line, "word": word, "changes": changes}


def _changing(done: History, segment: Segment, cycle: int | None = None) -> int:
    """Return how many words of a table changed during the run or, if `cycle` is given, in that cycle."""
    mine = [
        course
        for number, course in done.courses.items()
        if segment.base <= number < segment.base + segment.size
    ]
    return sum(each.changes if cycle is None else each.changed(cycle) for each in mine)


def overview(done: History, cycle: int) -> Iterator[str]:
    """List all tables. For each table, give the number of words that changed during the run, and the number of words
    that changed in one cycle.
    """
    yield f"{done.head.program}, {_moment(done, cycle)}"
    yield ""
    rows = [("table", "", "lines", "words", "words that change", "in this cycle")]
    for segment in done.segments:
        shape, moved, now = segment.shape, _changing(done, segment), _changing(done, segment, cycle)
        rows.append(
            (
                _title(done, segment),
                shape.title,
                str(shape.lines),
                str(shape.words),
                str(moved),
                str(now or ""),
            )
        )
    yield from columns(rows, words=2)


def table(done: History, segment: Segment, cycle: int, line: int | None = None) -> Iterator[str]:
    """Show a table, or one line of it, at the end of a cycle. Words that changed in the cycle are marked."""
    shape = segment.shape
    yield f"{_title(done, segment)}: {shape.title}, {_moment(done, cycle)}"
    yield ""
    if line is not None:
        _within(line, shape.lines, "line")
        for word in range(1, shape.words + 1):
            value = _word(done, segment, line, word, cycle)
            yield f"{segment.table} {line} {word:>2} {value:>8} {segment.name(word)}".rstrip()
        return
    lines, labels = done.used(segment), line_labels(segment.side, segment.table)
    words = range(1, shape.words + 1)
    rows = [
        ("line", "", *(segment.name(word) or (str(word) if shape.words > 1 else "word") for word in words))
    ]
    for n in lines:
        rows.append((str(n), labels.get(n, ""), *(_word(done, segment, n, word, cycle) for word in words)))
    yield from columns([row if labels else (row[0], *row[2:]) for row in rows], words=2 if labels else 1)
    left_out = shape.lines - len(lines)
    if left_out:
        yield ""
        yield f"{counted(left_out, 'unused line')} left out"


def course(done: History, segment: Segment, line: int, word: int) -> Iterator[str]:
    """List the changes of a word during the run."""
    _within(line, segment.shape.lines, "line")
    _within(word, segment.shape.words, "word")
    name = segment.name(word)
    yield f"{_title(done, segment)} {line} {word}{f', {name}' if name else ''}, during the run"
    yield ""
    found = done.courses.get(segment.number(line, word))
    if found is None:
        yield "the word has always been 0"
        return
    arm = done.find("AR", segment.side)
    rows = [("cycle", "time, s", "value", "statement")]
    for cycle, value in zip(found.cycles, found.values, strict=True):
        statement = done.value(arm.number(1, 3), cycle)
        text = done.head.statements.get(statement, "")
        rows.append(
            (str(cycle), f"{cycle / CYCLES_PER_SECOND:.2f}", str(value), f"{statement or ''} {text}".strip())
        )
    yield from columns(rows, words=1, last=True)


def _moment(done: History, cycle: int) -> str:
    passed = done.head.cycles
    if cycle < passed:
        return f"cycle {cycle} ({cycle / CYCLES_PER_SECOND:.2f} s)"
    return f"after cycle {passed - 1}, the last one" if passed else "before the first cycle"


def _title(done: History, segment: Segment) -> str:
    return f"{segment.table} ({segment.side})" if segment.side and len(done.head.sides) > 1 else segment.table


def _word(done: History, segment: Segment, line: int, word: int, cycle: int) -> str:
    number = segment.number(line, word)
    return f"{done.value(number, cycle)}{CHANGED if done.changed(number, cycle) else ' '}"


def _within(number: int, most: int, what: str) -> int:
    if not 1 <= number <= most:
        raise BadArgument(f"there is no {what} {number}: the {what}s are 1 to {most}")
    return number


def columns(rows: Sequence[Sequence[str]], *, words: int, last: bool = False) -> Iterator[str]:
    """Align rows in columns. The first `words` columns contain text. If `last` is True, the last column contains text,
    too. All other columns contain numbers, which are aligned to the right.
    """
    widths = [max(map(len, column)) for column in zip(*rows, strict=True)]
    for row in rows:
        cells = [
            cell.ljust(width) if n < words or (last and n == len(row) - 1) else cell.rjust(width)
            for n, (cell, width) in enumerate(zip(row, widths, strict=True))
        ]
        yield "  ".join(cells).rstrip()
