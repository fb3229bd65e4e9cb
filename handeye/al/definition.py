"""Definitions of instructions: the operands of each instruction, their kinds and units, and the role of the
instruction in the flow of the program.
"""

from enum import Enum, StrEnum
from typing import Final

from msgspec.structs import replace

from handeye.al.syntax import Name, Number, Value, Vector
from handeye.core import units
from handeye.core.record import Record
from handeye.ports import camera

MAX_NUMBER: Final = 1e6  # keeps squares of numbers finite
ANY: Final = "a number in a program can be at most one million"
MIN_POSITIVE: Final = 0.001

AXES: Final = ("X", "Y", "Z")  # unit vectors where a vector is expected; `FREE` and `SPIN` name them as axes
NIL: Final = "NIL"  # dialect of 1977: no force or moment


class OperandUnit(Record, frozen=True, kw_only=True):
    """The unit of an operand. `si` is the size of this unit in SI units."""

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
    """The kind of object that the name in an operand refers to."""

    POSITION = "position"
    PART = "part"
    TARGET = "position or part"
    PICTURE = "picture"
    VECTOR = "vector"
    COUNTER = "counter"
    SAVED = "saved difference"
    LABEL = "label"
    NEW = "new name"


class Document(Enum):
    """The source from which an instruction or an operand is known. `docs/sources.md` describes the sources."""

    PAPER_1973 = "paper 1973"
    MANUAL_1973 = "manual 1973"
    MANUAL_1976 = "manual 1976"
    LISTING_1977 = "listing 1977, from memory"
    MEMORY = "from memory, unverified"


class Operand(Record, frozen=True, kw_only=True):
    """One operand of an instruction, and the values that it accepts."""

    name: str  # in the manual
    takes: tuple[type[Value], ...]
    units: tuple[OperandUnit, ...] = ()  # one for a number; one per component of a vector
    low: float = -MAX_NUMBER
    high: float = MAX_NUMBER
    why: str = ANY
    whole: bool = False
    nonzero: bool = False  # at least MIN_POSITIVE in size
    choices: tuple[float, ...] = ()
    free: bool = False  # the rest of the line, with or without quotes
    components: tuple[str, ...] = ()  # letters of a vector, in brackets in its name
    optional: bool = False
    nil: bool = False  # accepts `NIL`
    refers: Refers = Refers.NEW
    word: str = ""  # keyword, alone or before the operand (`OF part`)
    ours: bool = False
    document: Document | None = None  # if it is not that of the instruction

    @property
    def is_vector(self) -> bool:
        """True if the operand must be a vector or the name of a vector."""
        return bool(self.components)

    @property
    def plain(self) -> str:
        """The name of the operand in the sentences of messages."""
        return f"vector {self.name}" if self.is_vector else self.name or f"word `{self.word}`"

    @property
    def shown(self) -> str:
        """The operand as the manual shows it; in parentheses if it is optional."""
        text = f"{self.word} {self.name}".strip()
        return f"({text})" if self.optional else text


def _name(document: Document | None) -> str:
    return "handeye" if document is None else document.value


class Role(Enum):
    """Role of an instruction in the flow of a program."""

    MOTION = "motion"
    MODIFIER = "modifier"  # of the next motion
    SHIFT = "shift"  # of the MOVE before
    SKIP = "skip"
    JUMP = "jump"  # to a label
    DECLARATION = "declaration"  # no step of its own
    STEP = "step"


MOTION, MODIFIER, SHIFT, SKIP, JUMP, DECLARATION, STEP = (
    Role  # members by name: looking one up in an Enum is slow
)


class Instruction(Record, frozen=True, kw_only=True):
    """An instruction of the language."""

    op: str
    group: str
    help: str
    operands: tuple[Operand, ...] = ()
    role: Role = Role.STEP
    axes: bool = False  # accepts a number of axes and their letters
    fits: tuple[str, ...] = ()  # motions that a modifier applies to
    document: Document | None = None  # None for an addition of handeye

    @property
    def ours(self) -> bool:
        """True if the instruction is an addition of handeye to the arm language of 1973."""
        return self.document is None

    @property
    def origin(self) -> str:
        """The document in which the instruction was found, or `handeye` for an addition of handeye. If some operands
        are from another document, their names and their origin are added.
        """
        own, others = _name(self.document), dict[str, list[str]]()
        for operand in self.operands:
            origin = self.origin_of(operand)
            if origin != own:
                others.setdefault(origin, []).append(f"`{operand.shown}`")
        return "; ".join([own, *(f"{', '.join(shown)}: {origin}" for origin, shown in others.items())])

    def origin_of(self, operand: Operand) -> str:
        """The document in which an operand was found, or `handeye` for an addition of handeye."""
        return _name(None if operand.ours else operand.document or self.document)

    @property
    def usage(self) -> str:
        """The instruction with its operands, as the manual shows it."""
        return " ".join((self.op, *(operand.shown for operand in self.operands)))


MAX_GAP_IN: Final = round(units.GAP / units.INCH, 2)
LENSES_MM: Final = tuple(lens / units.MILLIMETRE for lens in camera.LENSES)
MAX_STEP_IN: Final = 1.0


def number(
    name: str, unit: OperandUnit, low: float = -MAX_NUMBER, *, optional: bool = False, ours: bool = False
) -> Operand:
    """Define an operand that is a number in a unit, with an optional minimum."""
    why = f"the number must be at least {low:g} {unit.name}" if low > -MAX_NUMBER else ANY
    return Operand(name=name, takes=(Number,), units=(unit,), low=low, why=why, optional=optional, ours=ours)


def count(name: str, low: float, high: float, why: str, *, word: str = "") -> Operand:
    """Define an operand that is a whole number in a range. The operand is optional if it follows a keyword that
    handeye added to the language.
    """
    plain = number(name, ONE, low, optional=bool(word), ours=bool(word))
    return replace(plain, high=high, why=why, whole=True, word=word)


def gap(name: str, *, optional: bool = False, ours: bool = False) -> Operand:
    """Define an operand that is an opening of the hand, in inches."""
    why = f"a gap must be between 0 and {MAX_GAP_IN:g} in"
    return replace(number(name, IN, 0.0, optional=optional, ours=ours), high=MAX_GAP_IN, why=why)


def vector(**components: OperandUnit) -> Operand:
    """Define an operand that is a vector, with a letter and a unit for each component."""
    name, units = f"[{' '.join(components)}]", tuple(components.values())
    return Operand(name=name, takes=(Vector,), units=units, components=tuple(components))


def named_vector(unit: OperandUnit) -> Operand:
    """Define an operand that is a vector of three components in one unit, or the name of such a vector."""
    return replace(vector(x=unit, y=unit, z=unit), takes=(Vector, Name), refers=Refers.VECTOR)


def name_of(name: str, refers: Refers) -> Operand:
    """Define an operand that is the name of an object. `refers` is the kind of object."""
    return Operand(name=name, takes=(Name,), refers=refers)


def word(word: str, *, optional: bool = True, ours: bool = True) -> Operand:
    """Define an operand that is a keyword."""
    return Operand(name="", takes=(), word=word, optional=optional, ours=ours)


MOMENT: Final = Operand(
    name="moment", takes=(Vector, Name), units=(OZ_IN,) * 3, optional=True, nil=True, refers=Refers.VECTOR
)
ERROR: Final = count("error", 1, 63, "an error number must be from 1 to 63")
LENS: Final = Operand(name="mm", takes=(Number,), units=(MM,), choices=LENSES_MM)
_STEP_WHY = f"a step must be between {MIN_POSITIVE:g} and {MAX_STEP_IN:g} in"
SEARCH_STEP: Final = replace(number("step", IN, MIN_POSITIVE), high=MAX_STEP_IN, why=_STEP_WHY)
STEPS: Final = count("number", 1, 20, "a search must extend 1 to 20 steps to each side", word="STEPS")
TIMES: Final = count("number", 1, 100, "the number of times must be from 1 to 100", word="TIMES")
ALONG: Final = Operand(
    name="direction", takes=(Number,), units=(DEG,), word="ALONG", optional=True, ours=True
)
