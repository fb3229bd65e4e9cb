"""The edit commands, and the commands that show tables."""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Final

from handeye.systems.ml.background.numbers import table_name
from handeye.systems.ml.background.program import none_stored
from handeye.systems.ml.errors import MlError
from handeye.systems.ml.language.syntax import LAST
from handeye.systems.ml.tables.layout import SHAPES

if TYPE_CHECKING:
    from handeye.systems.ml.background.interpreter import Interpreter


def erase(mos: "Interpreter", first: int, last: int | None = None) -> None:
    mos.program.erase(first, first if last is None else last)


def listing(mos: "Interpreter", first: int | None = None, last: int | None = None) -> None:
    """List the whole program, one statement, or a range of statements."""
    low = 1 if first is None else first
    high = last if last is not None else LAST if first is None else first
    lines = mos.program.listing(low, high)
    if not lines and first is not None:
        raise MlError("M07", none_stored(low, high))
    for line in lines:
        mos.print(line)


def query_points(mos: "Interpreter") -> None:
    memory = mos.program.memory
    for number in memory.recent:
        mos.print(" ".join(map(str, (number, *memory.points.get(number, ("was erased",))))))


def query(mos: "Interpreter", table: int, *place: int) -> None:
    show(table_name(table), mos, *place)


def show(name: str, mos: "Interpreter", line: int | None = None, word: int | None = None) -> None:
    """Print one word of a table, one line of the table with the names of its words, or all lines in which any word is
    not 0.
    """
    shape, read = mos.level.shapes[name], mos.level.read
    if line is not None and word is not None:
        mos.print(str(read(name, line, word)))
        return
    if line is not None:
        words = [read(name, line, each) for each in range(1, shape.words + 1)]
        names = shape.names if len(shape.names) == shape.words else ("",) * shape.words
        for each, (value, title) in enumerate(zip(words, names, strict=True), 1):
            mos.print(f"{name} {line} {each:2} {value:6} {title}".rstrip())
        return
    mos.print(f"{name}: {shape.title}, {shape.lines} x {shape.words}")
    for each in range(1, shape.lines + 1):
        words = [read(name, each, at) for at in range(1, shape.words + 1)]
        if any(words):
            mos.print(f"{name} {each:2} {' '.join(map(str, words))}")


def file(mos: "Interpreter", table: int, line: int, word: int, *values: int) -> None:
    """Write consecutive words of a line. If the line is too short for all the words, nothing is written."""
    name = table_name(table)
    mos.level.read(name, line, word + len(values) - 1)
    for at, value in enumerate(values, word):
        mos.level.write(name, line, at, value)


EDIT: Final[dict[str, Callable[..., None]]] = {
    "ERASE": erase, "LIST": listing, "QPOINT": query_points, "QUERY": query, "FILE": file,
    **{name: partial(show, name) for name in SHAPES},
}  # fmt: skip
