"""The flow commands: branches, subroutines, loops, delays and the end."""

from collections.abc import Callable
from functools import partial
from typing import TYPE_CHECKING, Final

from handeye.systems.ml.background.numbers import COMPARISON, OVERFLOW
from handeye.systems.ml.errors import MlError

if TYPE_CHECKING:
    from handeye.systems.ml.background.interpreter import Interpreter

LINK: Final = (3, 3)  # line and word of RG: the statement to which RETURN goes, plus 1; 0: none
_LOOPS: Final = {"I": 1, "J": 2}  # lines of RG
_ACTIVE, _LEFT, _FIRST, _VARIABLE, _PASS = 1, 2, 3, 4, 5  # words of a loop


def branch(mos: "Interpreter", yes: int, no: int | None = None, *sensors: int) -> None:
    if no is None:
        mos.go(yes)
        return
    flags, last = mos.level.flags, mos.level.shapes["ST"].lines
    for sensor in sensors:
        if not 1 <= abs(sensor) <= last:
            raise MlError("M11", f"there is no sensor {sensor}; the last sensor is {last}")
    met = any((abs(each) in flags) == (each > 0) for each in sensors) if sensors else bool(flags)
    mos.go(yes if met else no)


def if_sign(mos: "Interpreter", value: int, less: int, equal: int, greater: int) -> None:
    mos.go(less if value < 0 else greater if value > 0 else equal)


def branch_and_link(mos: "Interpreter", variable: int, target: int) -> None:
    _stored(mos, "BAL")
    mos.program.statement(target)
    mos.set_variable(variable, mos.memory.at)
    mos.go(target)


def gosub(mos: "Interpreter", target: int) -> None:
    """Go to a subroutine. If a typed line has called the subroutine, the subroutine's RETURN ends the program."""
    if mos.memory.executing and mos.register(*LINK):
        raise MlError("M13", "GOSUB is not allowed in a subroutine that GOSUB has called; use BAL")
    back = mos.memory.at if mos.memory.executing else 0
    mos.go(target)
    mos.set_register(*LINK, back + 1)


def back(mos: "Interpreter") -> None:
    _stored(mos, "RETURN")
    link = mos.register(*LINK)
    if not link:
        raise MlError("M13", "RETURN has no GOSUB to go back to")
    mos.set_register(*LINK, 0)
    if link == 1:
        mos.end()
    else:
        mos.go(link - 1)


def loop(name: str, mos: "Interpreter", passes: int, variable: int = 0) -> None:
    _stored(mos, f"LOOP{name}")
    line, memory = _LOOPS[name], mos.memory
    if passes <= 0:
        mos.set_register(line, _ACTIVE, 0)
        memory.at = _after_end(mos, f"NEXT{name}")
        return
    if not memory.at:
        raise MlError("M13", f"LOOP{name} has no statement to repeat")
    if variable:
        mos.set_variable(variable, 1)
    for word, value in (
        (_ACTIVE, 1),
        (_LEFT, passes),
        (_FIRST, memory.at),
        (_VARIABLE, variable),
        (_PASS, 1),
    ):
        mos.set_register(line, word, value)


def next_pass(name: str, mos: "Interpreter") -> None:
    line = _LOOPS[name]
    if not mos.register(line, _ACTIVE):
        raise MlError("M13", f"NEXT{name} would end a loop, but no LOOP{name} has begun one")
    left = mos.register(line, _LEFT) - 1
    if left <= 0:
        mos.set_register(line, _ACTIVE, 0)
        return
    number = mos.register(line, _PASS) + 1
    mos.set_register(line, _LEFT, left)
    mos.set_register(line, _PASS, number)
    if variable := mos.register(line, _VARIABLE):
        mos.set_variable(variable, number)
    mos.go(mos.register(line, _FIRST))


def delay(mos: "Interpreter", hundredths: int) -> None:
    if hundredths > 0:
        mos.wait_until(mos.level.now + hundredths)


def stop(mos: "Interpreter") -> None:
    mos.end()


def _by_indicator(indicator: tuple[int, int]) -> Callable[..., None]:
    def branch_by(mos: "Interpreter", on: int, off: int | None = None) -> None:
        if mos.register(*indicator):
            mos.go(on)
        elif off is not None:
            mos.go(off)

    return branch_by


def _stored(mos: "Interpreter", code: str) -> None:
    if not mos.memory.executing:
        raise MlError("M13", f"{code} works only in a stored program")


def _after_end(mos: "Interpreter", code: str) -> int:
    """Find the next statement with the command `code`, which is NEXTI or NEXTJ. Return the number of the statement
    that follows it; 0 if no statement follows.
    """
    number = mos.memory.at
    while number:
        if mos.program.statement(number).code == code:
            return mos.program.after(number)
        number = mos.program.after(number)
    raise MlError("M13", f"no {code} follows, so the loop has no end")


JUMPS: Final[dict[str, Callable[..., None]]] = {
    "BRANCH": branch, "IF": if_sign, "BAL": branch_and_link, "GOSUB": gosub, "RETURN": back,
    "BRCOMP": _by_indicator(COMPARISON), "BROVFL": _by_indicator(OVERFLOW),
    "LOOPI": partial(loop, "I"), "LOOPJ": partial(loop, "J"),
    "NEXTI": partial(next_pass, "I"), "NEXTJ": partial(next_pass, "J"),
    "DELAY": delay, "STOP": stop,
}  # fmt: skip
