"""Tabletop: what somebody does with the things on the table, between two commands. Only imagined things obey words."""

from typing import Final

from handeye.diagnostics import quoted
from handeye.errors import InvalidInput
from handeye.trig.desk import number
from handeye.trig.no_arm import HEIGHT, TRAVEL, NoArm
from handeye.trig.teachable import Teachable
from handeye.units import MILLIMETRE

MARK: Final = "*"
"""How a line begins that is about the table."""
MOST: Final = int(TRAVEL[2][1] / HEIGHT)
"""Blocks of a stack that the arm can come above."""
_HELP: Final = "write `* STACK 20 X 150 Y 0`, or `* CLEAR`"


def arrange(arm: Teachable, line: str) -> str:
    """Do what a line says with the things on the table.

    Returns:
        What lies there now, in words.

    Raises:
        InvalidInput: it says nothing that can be done.
    """
    if not isinstance(arm, NoArm):
        raise InvalidInput(
            "what lies on a real table is put there by hand; `*` is for an arm that is imagined"
        )
    words = line.removeprefix(MARK).upper().split()
    match words:
        case ["STACK", count, "X", x, "Y", y] if count.isdecimal() and 0 < int(count[:9]) <= MOST:
            arm.stack(int(count), number(x) * MILLIMETRE, number(y) * MILLIMETRE)
        case ["STACK", count, "X", _, "Y", _]:
            raise InvalidInput(f"a stack has 1 to {MOST} blocks, not {quoted(count)}")
        case ["CLEAR"]:
            arm.clear()
        case _:
            raise InvalidInput(f"{quoted(' '.join(words))} cannot be done with a table; {_HELP}")
    return f"blocks on the table: {len(arm.blocks)}"
