"""The kinds of places for operands that instructions have."""

from dataclasses import replace
from typing import Final

from handeye.al.definition import (
    ANY,
    BIGGEST,
    DEG,
    IN,
    MM,
    ONE,
    OZ_IN,
    SMALLEST,
    Operand,
    OperandUnit,
    Refers,
)
from handeye.al.syntax import Name, Number, Vector
from handeye.core import units
from handeye.ports import camera

HAND: Final = round(units.GAP / units.INCH, 2)
"""Widest opening of the hand, in."""
LENSES: Final = tuple(lens / units.MILLIMETRE for lens in camera.LENSES)
"""Focal lengths of the lenses on the turret, mm."""
LARGEST_STEP: Final = 1.0
"""in, of a search."""


def number(
    name: str, unit: OperandUnit, low: float = -BIGGEST, *, optional: bool = False, ours: bool = False
) -> Operand:
    """A number in a unit, perhaps with a least one."""
    why = f"it must be at least {low:g} {unit.name}" if low > -BIGGEST else ANY
    return Operand(name=name, takes=(Number,), units=(unit,), low=low, why=why, optional=optional, ours=ours)


def gap(name: str, *, optional: bool = False, ours: bool = False) -> Operand:
    """An opening of the hand."""
    why = f"the hand opens from 0 to {HAND:g} in"
    return Operand(
        name=name, takes=(Number,), units=(IN,), low=0.0, high=HAND, why=why, optional=optional, ours=ours
    )


def vector(**components: OperandUnit) -> Operand:
    """A vector, with a letter and a unit for each component."""
    name, units = f"[{' '.join(components)}]", tuple(components.values())
    return Operand(name=name, takes=(Vector,), units=units, components=tuple(components))


def named_vector(unit: OperandUnit) -> Operand:
    """A vector of three components in one unit, or the name of one."""
    return replace(vector(x=unit, y=unit, z=unit), takes=(Vector, Name), refers=Refers.VECTOR)


def name_of(name: str, refers: Refers) -> Operand:
    """A name, and what it has to be the name of."""
    return Operand(name=name, takes=(Name,), refers=refers)


def also(name: str, refers: Refers) -> Operand:
    """One more such name, which may be left out."""
    return Operand(name=name, takes=(Name,), refers=refers, optional=True)


def word(word: str, *, optional: bool = True, ours: bool = True) -> Operand:
    """A word of the language, which may be left out or not."""
    return Operand(name="", takes=(), word=word, optional=optional, ours=ours)


MOMENT: Final = Operand(
    name="moment", takes=(Vector, Name), units=(OZ_IN,) * 3, optional=True, nil=True, refers=Refers.VECTOR
)
ERROR: Final = Operand(
    name="error",
    takes=(Number,),
    units=(ONE,),
    low=1,
    high=63,
    why="errors have numbers from 1 to 63",
    whole=True,
)
LENS: Final = Operand(name="mm", takes=(Number,), units=(MM,), choices=LENSES)
STEP: Final = Operand(
    name="step",
    takes=(Number,),
    units=(IN,),
    low=SMALLEST,
    high=LARGEST_STEP,
    why=f"a step is {SMALLEST:g} to {LARGEST_STEP:g} in: a search extends several to each side",
)
STEPS: Final = Operand(
    name="number",
    takes=(Number,),
    units=(ONE,),
    low=1,
    high=20,
    why="a search extends 1 to 20 steps to each side",
    whole=True,
    word="STEPS",
    optional=True,
    ours=True,
)
TIMES: Final = Operand(
    name="number",
    takes=(Number,),
    units=(ONE,),
    low=1,
    high=100,
    why="a stage is undone 1 to 100 times",
    whole=True,
    word="TIMES",
    optional=True,
    ours=True,
)
ALONG: Final = Operand(
    name="direction", takes=(Number,), units=(DEG,), word="ALONG", optional=True, ours=True
)
