"""Words that people write by a slip, or because another language has them, and the word that helps them on."""

import re
from typing import Final

from handeye.al.unitwords import no_units
from handeye.core.diagnostics import LOOKALIKES

_COMMENT: Final = "a comment begins with `;`"
_BLANKS: Final = "operands follow their instruction after a blank"
_VECTOR: Final = "write a vector in brackets, as `[0 0 -1]`"
_NUMBER: Final = r"[+-]?(?:\d+\.?\d*|\.\d+)"
_PLAIN: Final = re.compile(_NUMBER, re.ASCII)
_WITH_UNIT: Final = re.compile(rf"({_NUMBER})([A-Za-z]+)", re.ASCII)

_ENDS: Final = "a program ends where its text ends"
_TESTS: Final = "`SKIPE` and `SKIPN` test an error, and skip one instruction"
_ROUNDS: Final = "`JUMP` goes back to a label; `ASSIGN` and `SOJG` count the rounds"
_MACRO: Final = "`DEFINE` makes a macro, which ends with a blank line"
_CALL: Final = "the name of a macro calls it, with its operands behind"
_PAUSE: Final = "no instruction waits for a time; `WAIT` calls the operator"
_STRAIGHT: Final = "`CHANGE` moves straight from where the hand is, `MOVE` goes to a position"
_GRASP: Final = "`CLOSE` grasps; `CENTER` grasps without pushing"

_ELSEWHERE: Final[dict[str, str]] = {
    **dict.fromkeys(("END", "ENDPROGRAM", "EXIT", "HALT", "QUIT"), _ENDS),
    **dict.fromkeys(
        ("RETURN", "RET", "ENDDEF", "ENDPROC", "ENDSUB"), f"a macro ends with a blank line; {_ENDS}"
    ),
    **dict.fromkeys(("IF", "THEN", "ELSE", "ELSEIF", "ENDIF", "CASE", "SWITCH"), _TESTS),
    **dict.fromkeys(("FOR", "WHILE", "LOOP", "REPEAT", "UNTIL", "NEXT"), _ROUNDS),
    **dict.fromkeys(("GOTO", "BRANCH", "JMP"), "`JUMP` goes to a label"),
    **dict.fromkeys(("CALL", "GOSUB", "PERFORM"), _CALL),
    **dict.fromkeys(("MACRO", "PROC", "PROCEDURE", "SUB", "SUBROUTINE", "FUNCTION", "DEF"), _MACRO),
    **dict.fromkeys(("INCLUDE", "IMPORT", "USE"), "`REQUIRE` reads another file"),
    **dict.fromkeys(("DELAY", "PAUSE", "SLEEP", "DWELL", "TIMER"), _PAUSE),
    **dict.fromkeys(("PRINT", "SAY", "TYPE", "MESSAGE"), "`WAIT` shows the operator a text, and stops"),
    **dict.fromkeys(("MOVEL", "MOVES", "MOVEJ", "LINEAR", "APPRO", "DEPART", "LIFT", "LOWER"), _STRAIGHT),
    **dict.fromkeys(("GRASP", "GRIP", "GRAB", "PICK", "CLAMP"), _GRASP),
    **dict.fromkeys(("RELEASE", "LETGO", "UNGRASP", "DROP"), "`OPEN` lets go"),
    **dict.fromkeys(("HOME", "REST"), "`PARK` goes to the position called PARK"),
    **dict.fromkeys(("SPEED", "VELOCITY"), "`CHANGE` takes a speed last, in inches a second"),
    **dict.fromkeys(("LET", "SET", "VAR", "INT"), "`ASSIGN` sets a counter"),
    **dict.fromkeys(("POINT", "FRAME", "POSE"), "`TRANS` defines a position"),
}
"""Words of other languages, and how it is said in this one."""


def elsewhere(word: str) -> str | None:
    """How that is said here which another language says with this word; None if no such word is known."""
    return _ELSEWHERE.get(word.upper())


def alone(word: str) -> str | None:
    """Help for an instruction that stands there without an operand, as another language has it."""
    return (
        f"it ends the motion after it when the hand presses with so many ounces; {_ENDS}"
        if word == "STOP"
        else None
    )


def with_digits(text: str) -> str | None:
    """The number that is meant by a text in which letters stand for digits they look like; None: there is none."""
    right = text.translate(LOOKALIKES)
    return right if right != text and _PLAIN.fullmatch(right) else None


def letters_for_digits(text: str) -> str | None:
    """Help for a text in which letters stand for digits; None if they do not."""
    right = with_digits(text)
    return None if right is None else f"write a digit, not a letter that looks like it: `{right}`"


def with_unit(text: str) -> tuple[str, str] | None:
    """A unit written against its number, and what to say of it; None if that is not what the text is."""
    found = _WITH_UNIT.fullmatch(text)
    said = None if found is None else no_units(found[2])
    return None if found is None or said is None else (found[2], said)


def strange(text: str) -> str | None:
    """Help for characters that are no part of the language; None if nothing helps."""
    first = text[0]
    if first == ":":
        return "a colon belongs after a label, at the beginning of a line"
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
        return 'use straight quotes, as `"this"`'
    if first in "+-" and text[1:2].isalpha():
        return letters_for_digits(text) or f"a name has no sign; {_VECTOR}"
    if first == "\N{NO-BREAK SPACE}":
        return "use an ordinary blank"
    if first.isalpha():
        return "names consist of letters from A to Z, digits and `_`"
    return None
