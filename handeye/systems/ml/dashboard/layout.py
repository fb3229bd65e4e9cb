"""Gives each word of each table of a machine a number, so that a recording can name a word by one integer."""

from collections.abc import Sequence
from typing import Final, NamedTuple

from handeye.systems.ml.level import Shape, Side
from handeye.systems.ml.machine.rectilinear import LEFT, RIGHT
from handeye.systems.ml.machine.spec import ArmSpec
from handeye.systems.ml.tables.layout import SHAPES
from handeye.systems.ml.tables.records import ANALOG
from handeye.systems.ml.tables.store import ArmMemory

PROGRAM: Final = "TK"
_OF_EACH_ARM: Final = {*ArmMemory.__struct_fields__, "TR", "LG", "HL"}
_SPECS: Final[dict[Side, ArmSpec]] = {"right": RIGHT, "left": LEFT}


class Segment(NamedTuple):
    """A table of one arm, or a table that both arms share."""

    side: str  # the arm; empty: both arms share the table
    table: str
    base: int  # number of the table's first word
    shape: Shape

    @property
    def size(self) -> int:
        """Number of words of the table."""
        return self.shape.lines * self.shape.words

    def number(self, line: int, word: int) -> int:
        """Return the number of a word. Lines and words count from 1."""
        return self.base + (line - 1) * self.shape.words + word - 1

    def line_word(self, number: int) -> tuple[int, int]:
        """Return the position of a word: its line, and its place in the line. `number` is the number of the word.
        Lines and words count from 1.
        """
        line, word = divmod(number - self.base, self.shape.words)
        return line + 1, word + 1

    @property
    def names(self) -> list[str]:
        """The names of the words of a line; empty if the words have no names."""
        names = self.shape.names
        return [name.replace("_", " ") for name in names] if len(names) == self.shape.words else []

    def name(self, word: int) -> str:
        """Return the name of a word of a line; empty if the word has no name."""
        return self.names[word - 1] if self.names else ""


def segments(sides: Sequence[Side]) -> list[Segment]:
    """Return all tables of a machine that has the arms `sides`. The table whose words have the lowest numbers comes
    first.
    """
    found: list[Segment] = []
    base = 0
    for side in sides:
        for table, shape in SHAPES.items():
            own = table in _OF_EACH_ARM
            if own or side == sides[0]:
                found.append(Segment(side if own else "", table, base, shape))
                base += found[-1].size
    return found


def line_labels(side: str, table: str) -> dict[int, str]:
    """Return the axis, channel or interlock to which each line of a table is connected. Other lines are left out."""
    spec = _SPECS["left" if side == "left" else "right"]
    axes = {motor.number: motor.axis for motor in spec.motors}
    analog = {point: source.channel for point, source in spec.analog.items()}
    match table:
        case "MT" | "WS":
            labels = axes
        case "AI":
            labels = axes | analog
        case "AO":
            labels = {motor.output: motor.axis for motor in spec.motors if motor.output > 0}
        case "DI":
            labels = {word: ", ".join(names) for word, names in spec.digital.items()}
        case "DO":
            labels = {1: ", ".join(spec.tools)} if spec.tools else {}
        case "SF":
            labels = dict(enumerate(spec.interlocks, 1))
        case "ST":
            labels = {
                number: analog.get(line.input, "")
                if line.kind == ANALOG
                else _masked(spec, line.input, line.mask)
                for number, line in spec.sensors.items()
            }
        case _:
            labels = {}
    return {line: label.replace("_", " ") for line, label in labels.items()}


def _masked(spec: ArmSpec, word: int, mask: int) -> str:
    return ", ".join(name for bit, name in enumerate(spec.digital[word]) if mask >> bit & 1)
