"""Describes operands for the manual, and for the hover texts of editors."""

from typing import Final

from handeye.al.definition import (
    DECLARATION,
    MAX_NUMBER,
    MODIFIER,
    MOTION,
    Document,
    Instruction,
    Operand,
    Refers,
)
from handeye.al.syntax import Name, Number, Text, Vector

_CALLED: Final = {
    Refers.NEW: "a name",
    Refers.LABEL: "a label",
    Refers.TARGET: "the name of a position or a part",
    Refers.SAVED: "the name of a saved difference",
}

_FOUND_IN: Final = {
    None: "handeye adds this {}.",
    Document.PAPER_1973: "The paper of 1973 has this {}.",
    Document.MANUAL_1973: "The arm program's manual of 1973 has this {}.",
    Document.MANUAL_1976: "A manual of 1976, which describes a later arm program, has this {}.",
    Document.LISTING_1977: "The listing of 1977 has this {}. We know this listing only from memory.",
    Document.MEMORY: "We remember this {} from a later publication, and have not verified it.",
}


def takes(definition: Instruction, operand: Operand) -> str:
    """Describe the values that an operand of an instruction accepts."""
    kinds = {
        Vector: f"{len(operand.units)} numbers in brackets{_units(operand)}",
        Number: f"{'a whole number' if operand.whole else 'a number'}{_units(operand)}",
        Name: _CALLED.get(operand.refers, f"the name of a {operand.refers.value}"),
        Text: "text, up to the end of the line" if operand.free else "text in quotes",
    }
    choices = [*(kinds[kind] for kind in operand.takes), *["`NIL`"] * operand.nil]
    said = ", or ".join(choices) or "this word"
    counted = ", or the number of axes and their letters, such as `2 X Y`" if definition.axes else ""
    return "; ".join([said, *_limits(operand)]) + counted


def part(definition: Instruction) -> str:
    """Describe the role of an instruction and the document that the instruction comes from."""
    named = definition.role in (MOTION, MODIFIER, DECLARATION)
    role = definition.role.value if named else "instruction"
    said = _FOUND_IN[definition.document].format(role)
    modified = ", ".join(f"`{word}`" for word in definition.fits)
    return f"{said} `{definition.op}` can modify {modified}." if modified else said


def _units(operand: Operand) -> str:
    names = dict.fromkeys(unit.name for unit in operand.units if unit.name)
    return f" ({', '.join(names)})" if names else ""


def _limits(operand: Operand) -> list[str]:
    if operand.choices:
        return [" or ".join(f"{choice:g}" for choice in operand.choices)]
    if operand.low == operand.high:
        return [f"only {operand.low:g}"]
    if operand.high < MAX_NUMBER:
        return [f"{operand.low:g} to {operand.high:g}"]
    if operand.low > -MAX_NUMBER:
        return [f"at least {operand.low:g}"]
    return ["not 0"] if operand.nonzero else []
