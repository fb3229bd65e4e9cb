"""Kinds of operands that instructions share."""

from typing import Final

from msgspec.structs import replace

from handeye.al.definition import (
    ANY,
    DEG,
    IN,
    MAX_NUMBER,
    MIN_POSITIVE,
    MM,
    ONE,
    OZ_IN,
    Operand,
    OperandUnit,
    Refers,
)
from handeye.al.syntax import Name, Number, Vector
from handeye.core import units
from handeye.ports import camera

MAX_GAP_IN: Final = round(units.GAP / units.INCH, 2)
LENSES_MM: Final = tuple(lens / units.MILLIMETRE for lens in camera.LENSES)
MAX_STEP_IN: Final = 1.0


def number(
    name: str, unit: OperandUnit, low: float = -MAX_NUMBER, *, optional: bool = False, ours: bool = False
) -> Operand:
    """A number in a unit, perhaps with a minimum."""
    why = f"it must be at least {low:g} {unit.name}" if low > -MAX_NUMBER else ANY
    return Operand(name=name, takes=(Number,), units=(unit,), low=low, why=why, optional=optional, ours=ours)


def count(name: str, low: float, high: float, why: str, *, word: str = "") -> Operand:
    """A whole number in a range; after a keyword of ours it is optional."""
    ours = bool(word)
    return Operand(
        name=name, takes=(Number,), units=(ONE,), low=low, high=high, why=why, whole=True,
        word=word, optional=ours, ours=ours,
    )  # fmt: skip


def gap(name: str, *, optional: bool = False, ours: bool = False) -> Operand:
    """An opening of the hand."""
    why = f"the hand opens from 0 to {MAX_GAP_IN:g} in"
    return Operand(
        name=name,
        takes=(Number,),
        units=(IN,),
        low=0.0,
        high=MAX_GAP_IN,
        why=why,
        optional=optional,
        ours=ours,
    )


def vector(**components: OperandUnit) -> Operand:
    """A vector, with a letter and a unit for each component."""
    name, units = f"[{' '.join(components)}]", tuple(components.values())
    return Operand(name=name, takes=(Vector,), units=units, components=tuple(components))


def named_vector(unit: OperandUnit) -> Operand:
    """A vector of three components in one unit, or the name of one."""
    return replace(vector(x=unit, y=unit, z=unit), takes=(Vector, Name), refers=Refers.VECTOR)


def name_of(name: str, refers: Refers) -> Operand:
    """The name of something of a kind."""
    return Operand(name=name, takes=(Name,), refers=refers)


def also(name: str, refers: Refers) -> Operand:
    """An optional further name of that kind."""
    return Operand(name=name, takes=(Name,), refers=refers, optional=True)


def word(word: str, *, optional: bool = True, ours: bool = True) -> Operand:
    """A keyword, optional or not."""
    return Operand(name="", takes=(), word=word, optional=optional, ours=ours)


MOMENT: Final = Operand(
    name="moment", takes=(Vector, Name), units=(OZ_IN,) * 3, optional=True, nil=True, refers=Refers.VECTOR
)
ERROR: Final = count("error", 1, 63, "errors have numbers from 1 to 63")
LENS: Final = Operand(name="mm", takes=(Number,), units=(MM,), choices=LENSES_MM)
STEP: Final = Operand(
    name="step",
    takes=(Number,),
    units=(IN,),
    low=MIN_POSITIVE,
    high=MAX_STEP_IN,
    why=f"a step is {MIN_POSITIVE:g} to {MAX_STEP_IN:g} in: a search extends several to each side",
)
STEPS: Final = count("number", 1, 20, "a search extends 1 to 20 steps to each side", word="STEPS")
TIMES: Final = count("number", 1, 100, "a stage is undone 1 to 100 times", word="TIMES")
ALONG: Final = Operand(
    name="direction", takes=(Number,), units=(DEG,), word="ALONG", optional=True, ours=True
)
