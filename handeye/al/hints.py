"""Hints for typing errors, and for words of other languages."""

import re
from typing import Final

from handeye.core.diagnostics import LOOKALIKES

_COMMENT: Final = "a comment begins with `;`"
_BLANKS: Final = "use only spaces here: a space separates an instruction from its operands"
_VECTOR: Final = "write a vector in brackets, such as `[0 0 -1]`"
_NUMBER: Final = r"[+-]?(?:\d+\.?\d*|\.\d+)"
_PLAIN: Final = re.compile(_NUMBER, re.ASCII)
_WITH_UNIT: Final = re.compile(rf"({_NUMBER})([A-Za-z]+)", re.ASCII)

_ENDS: Final = "a program needs no end statement: it ends after its last line"
_MACRO_ENDS: Final = f"a macro ends with a blank line; {_ENDS}"
_TESTS: Final = "`SKIPE` and `SKIPN` test for an error and skip one instruction"
_ROUNDS: Final = (
    "to repeat lines, jump back to a label with `JUMP`; to count the rounds, use `ASSIGN` and `SOJG`"
)
_MACRO: Final = "`DEFINE` begins a macro, and a blank line ends it"
_CALL: Final = "to call a macro, write its name and then its operands"
_PAUSE: Final = "no instruction waits for a number of seconds; `WAIT` calls the operator"
_STRAIGHT: Final = (
    "`CHANGE` moves the hand in a straight line from its present place; `MOVE` moves the hand to a position"
)
_GRASP: Final = "`CLOSE` grasps; `CENTER` grasps without pushing"

_ELSEWHERE: Final[dict[str, str]] = {
    **dict.fromkeys(("END", "ENDPROGRAM", "EXIT", "HALT", "QUIT"), _ENDS),
    **dict.fromkeys(("RETURN", "RET", "ENDDEF", "ENDPROC", "ENDSUB"), _MACRO_ENDS),
    **dict.fromkeys(("IF", "THEN", "ELSE", "ELSEIF", "ENDIF", "CASE", "SWITCH"), _TESTS),
    **dict.fromkeys(("FOR", "WHILE", "LOOP", "REPEAT", "UNTIL", "NEXT"), _ROUNDS),
    **dict.fromkeys(("GOTO", "BRANCH", "JMP"), "`JUMP` goes to a label"),
    **dict.fromkeys(("CALL", "GOSUB", "PERFORM"), _CALL),
    **dict.fromkeys(("MACRO", "PROC", "PROCEDURE", "SUB", "SUBROUTINE", "FUNCTION", "DEF"), _MACRO),
    **dict.fromkeys(("INCLUDE", "IMPORT", "USE"), "`REQUIRE` reads another file"),
    **dict.fromkeys(("DELAY", "PAUSE", "SLEEP", "DWELL", "TIMER"), _PAUSE),
    **dict.fromkeys(
        ("PRINT", "SAY", "TYPE", "MESSAGE"), "`WAIT` shows the operator a text and stops the program"
    ),
    **dict.fromkeys(("MOVEL", "MOVES", "MOVEJ", "LINEAR", "APPRO", "DEPART", "LIFT", "LOWER"), _STRAIGHT),
    **dict.fromkeys(("GRASP", "GRIP", "GRAB", "PICK", "CLAMP"), _GRASP),
    **dict.fromkeys(("RELEASE", "LETGO", "UNGRASP", "DROP"), "`OPEN` releases what the fingers hold"),
    **dict.fromkeys(("HOME", "REST"), "`PARK` goes to the position called PARK"),
    **dict.fromkeys(("SPEED", "VELOCITY"), "the last operand of `CHANGE` is its speed, in inches per second"),
    **dict.fromkeys(("LET", "SET", "VAR", "INT"), "`ASSIGN` sets a counter"),
    **dict.fromkeys(("POINT", "FRAME", "POSE"), "`TRANS` defines a position"),
}


# for a STOP without an operand, as other languages write it
STOP_ALONE: Final = (
    f"`STOP` ends the next motion when the hand presses with the given force, in ounces; {_ENDS}"
)


def elsewhere(word: str) -> str | None:
    """Return the form in which this language expresses a word of another language, or None if the word is not known."""
    return _ELSEWHERE.get(word.upper())


def with_digits(text: str) -> str | None:
    """Replace letters that look like digits, and return the number that was meant: 10 for the text `1O`. Returns None
    if the text is not a number with letters in place of digits.
    """
    right = text.translate(LOOKALIKES)
    return right if right != text and _PLAIN.fullmatch(right) else None


def letters_for_digits(text: str) -> str | None:
    """Return a hint for a number with letters in place of digits, or None if the text is not written in this way."""
    right = with_digits(text)
    return None if right is None else f"write a digit, not a letter that looks like it: `{right}`"


def with_unit(text: str) -> tuple[str, str] | None:
    """Find a unit written directly after its number. Returns the unit and a hint. Returns None if the text is not a
    number with a unit.
    """
    found = _WITH_UNIT.fullmatch(text)
    said = None if found is None else no_units(found[2])
    return None if found is None or said is None else (found[2], said)


def strange(text: str) -> str | None:
    """Return a hint for characters outside the language, or None if there are none."""
    first = text[0]
    if first == ":":
        return "only a label ends with a colon, and a label must be the first word of its line"
    if first in "#/'":
        return _COMMENT
    if first in "({<" or text[-1] in ")}>":
        inside = text.strip("({<>})")
        return _VECTOR if not inside or _PLAIN.fullmatch(inside) else _BLANKS
    if first == "=":
        return _BLANKS
    if first in "−–—":
        return f"use an ordinary minus sign: `-{text[1:]}`"
    if first in "“”„«»‘’":
        return 'use straight quotes, as in `"this"`'
    if first in "+-" and text[1:2].isalpha():
        return letters_for_digits(text) or f"a name cannot have a sign; {_VECTOR}"
    if first == "\N{NO-BREAK SPACE}":
        return "use an ordinary space"
    if first.isalpha():
        return "names consist of letters from A to Z, digits and `_`"
    return None


_LENGTH, _ANGLE = "distances are in inches", "angles are in degrees"
_FORCE = "forces and weights are in ounces; moments and torques are in ounce-inches"
_SPEED = "speeds are in inches per second; the speed of the screwdriver is in revolutions per minute"
UNIT_WORDS: Final = {
    **dict.fromkeys(("in", "inch", "inches", "ft", "mm", "cm", "m"), _LENGTH),
    **dict.fromkeys(("oz", "ounce", "ounces", "lb", "lbs", "g", "kg", "n", "nm", "ozin"), _FORCE),
    **dict.fromkeys(("deg", "degree", "degrees", "rad"), _ANGLE),
    **dict.fromkeys(("ips", "rpm"), _SPEED),
}  # in small letters


def no_units(word: str) -> str | None:
    """Return a hint for a word that may be a unit, or None if the word cannot be a unit."""
    said = UNIT_WORDS.get(word.lower())
    return None if said is None else f"write numbers without a unit: {said}"
