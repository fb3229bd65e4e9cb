"""Definition of an instruction: its operands, their units, and its part in the flow."""

from dataclasses import dataclass
from enum import Enum, StrEnum
from typing import Final

from handeye.al.syntax import Value
from handeye.core import units

BIGGEST: Final = 1e6
"""No number of a program is larger; keeps squares of numbers finite."""
ANY: Final = "numbers in a program go up to a million"
SMALLEST: Final = 0.001
"""Least size of what has to be larger than nothing, in its unit."""

AXES: Final = ("X", "Y", "Z")
"""Letters of the table's axes: unit vectors where a vector stands, and what `FREE` and `SPIN` count."""
NIL: Final = "NIL"
"""Stands in the dialect of 1977 for a force or moment there is none of."""


@dataclass(frozen=True, slots=True, kw_only=True)
class OperandUnit:
    """A unit as written, and its SI value."""

    name: str
    si: float


ONE = OperandUnit(name="", si=1.0)
IN = OperandUnit(name="in", si=units.INCH)
IN_PER_S = OperandUnit(name="in/s", si=units.INCH)
MM = OperandUnit(name="mm", si=units.MILLIMETRE)
DEG = OperandUnit(name="degrees", si=units.DEGREE)
OZ = OperandUnit(name="oz", si=units.OUNCE_FORCE)
OZ_IN = OperandUnit(name="oz-in", si=units.OUNCE_INCH)
REV_PER_MIN = OperandUnit(name="rpm", si=units.RPM)


class Refers(StrEnum):
    """Kinds of things that a name must be the name of."""

    POSITION = "position"
    PART = "part"
    TARGET = "position or part"
    PICTURE = "picture"
    VECTOR = "vector"
    COUNTER = "counter"
    SAVED = "saved difference"
    LABEL = "label"
    NEW = "new name"


@dataclass(frozen=True, slots=True, kw_only=True)
class Operand:
    """One place of an instruction, and what may stand there."""

    name: str
    """As the manual calls it."""
    takes: tuple[type[Value], ...]
    units: tuple[OperandUnit, ...] = ()
    """Of a number: one; of a vector: one for each component."""
    low: float = -BIGGEST
    high: float = BIGGEST
    why: str = ANY
    whole: bool = False
    nonzero: bool = False
    """Not too near to nothing, on either side of it."""
    choices: tuple[float, ...] = ()
    free: bool = False
    """Words up to the end of the line, with or without quotes."""
    components: tuple[str, ...] = ()
    """The letters of a vector, which its name has in brackets."""
    optional: bool = False
    nil: bool = False
    """`NIL` may stand here, for nothing."""
    refers: Refers = Refers.NEW
    word: str = ""
    """A word of the language that stands here, alone or (`OF part`) before the operand."""
    ours: bool = False

    @property
    def is_vector(self) -> bool:
        """True if nothing but a vector, or the name of one, may stand here."""
        return bool(self.components)

    @property
    def plain(self) -> str:
        """As a sentence calls it."""
        return f"vector {self.name}" if self.is_vector else self.name or f"word `{self.word}`"

    @property
    def shown(self) -> str:
        """As it stands in the manual; what is optional in parentheses."""
        text = f"{self.word} {self.name}".strip()
        return f"({text})" if self.optional else text


class Role(Enum):
    """Role of an instruction in the flow of a program."""

    MOTION = "motion"
    MODIFIER = "modifier"  # of the next motion
    SHIFT = "shift"  # of the MOVE before
    SKIP = "skip"
    JUMP = "jump"  # to a label
    DECLARATION = "declaration"  # no step of its own
    STEP = "step"


MOTION, MODIFIER, SHIFT, SKIP, JUMP, DECLARATION, STEP = Role
"""The members by themselves, for code that asks often: looking one up in its enumeration takes time."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Instruction:
    """An instruction of the language."""

    op: str
    group: str
    help: str
    operands: tuple[Operand, ...] = ()
    role: Role = Role.STEP
    axes: bool = False
    """Its vector may be written as a number of axes and their letters."""
    fits: tuple[str, ...] = ()
    """Motions a modifier can modify."""
    ours: bool = False

    @property
    def origin(self) -> str:
        """`period`, `ours`, or which operands of a word of the period are ours."""
        added = ", ".join(f"`{operand.shown}`" for operand in self.operands if operand.ours)
        return "ours" if self.ours else f"period; {added} ours" if added else "period"

    @property
    def usage(self) -> str:
        """The instruction with its operands."""
        return " ".join((self.op, *(operand.shown for operand in self.operands)))
