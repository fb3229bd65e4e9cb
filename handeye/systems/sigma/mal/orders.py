"""Lists the problems that a program has if its tasks run in certain orders. The referees of exercises and benches use
this list.
"""

from collections.abc import Iterator
from typing import Final

from handeye.systems.sigma.mal.compiler import MalProgram, program_of
from handeye.systems.sigma.mal.interleavings import (
    KINDS,
    FindingKind,
    Interleavings,
    interleavings,
    schedule_lines,
    unreached_lines,
)

_STOPPING: Final[tuple[FindingKind, ...]] = ("deadlock", "stops")
"""Kinds of problems that stop the program. A program does not notice problems of the other kinds."""


def problems(program: MalProgram, found: Interleavings) -> Iterator[tuple[bool, str, str]]:
    """Yield the problems of a program, the worst problem first. Each problem is a tuple: True if the program does not
    notice the problem, a text that says what happens, and an example.
    """
    for each in sorted(found.findings, key=lambda finding: finding.kind in _STOPPING):
        order = "; ".join(" ".join(line.split()) for line in schedule_lines(each.schedule))
        yield each.kind not in _STOPPING, KINDS[each.kind], f"{each.told}. Order of the tasks: {order}"
    if not found.complete:
        yield False, "too many orders", f"the program has more than {found.states} states; make it simpler"
    if not found.ends:
        yield False, "the program never ends", "no order of the tasks leads to the end"
    if lines := unreached_lines(program, found):
        yield True, "lines are never executed", f"no order of the tasks reaches {lines}"


def order_problems(name: str, text: str) -> list[tuple[bool, str]]:
    """Return the problems that a program has if its tasks run in certain orders, the worst problem first. Each problem
    is a tuple: True if the program does not notice the problem, and a sentence that describes the problem. Raises
    BadFile if the text has errors.
    """
    program = program_of(name, text)
    return [(silent, f"{what}: {told}") for silent, what, told in problems(program, interleavings(program))]
