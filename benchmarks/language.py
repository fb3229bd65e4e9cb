"""Measures delays of the arm language: a check, a keystroke and a plan.

Each measurement uses a new text with different numbers and names, so that no result of an earlier one can be reused.
"""

import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from dataclasses import replace as replaced
from functools import partial
from statistics import median
from typing import Final

from msgspec.structs import replace

from benchmarks.keystrokes import typed
from handeye.al import AL, compile_text
from handeye.core.source import Source, read_source
from handeye.planning.planner import plan_source
from handeye.program.program import Position
from handeye.program.taught import Taught, load_taught
from handeye.runs.scripts import default_script
from handeye.tasks import task

LINES: Final = 2400
TYPED_LINES: Final = 1000
_BLOCK: Final = """\
; pin {name}: the listing of 1973, with other names and numbers
        TRANS   P{name} [{x:.3f} 44 4.5 -90 90 0]
        TRANS   T{name} [30 {y:.3f} 6 -90 90 0]
        VECT    V{name} [0 0 -{force}]
        ASSIGN  N{name} 3
A{name}: MOVE    P{name}         ;GO TO THE PIN
        CLOSE   .1              ;grasp it
        SKIPE   2               ;nothing is between the fingers
        JUMP    G{name}
        OPEN    1
        SOJG    N{name} A{name}
        WAIT    "NO PIN {name}"
G{name}: MOVE    T{name}         ;GO TO THE HOLE
        SEARCH  .07
L{name}: MOVE    T{name}         ;GO TO THE HOLE
        STOP    V{name}
        CHANGE  [0 0 -1] .{depth} ;TRY TO GO DOWN WITHOUT MEETING RESISTANCE
        SKIPE   23
        AOJ     L{name}
        SAVE    H{name}
        OPEN    .5
        MOVE    P{name}
        RESTORE H{name} LEVEL
        CLOSE   .1 .5           ;AND CHECK THAT IT IS STILL THERE
        OPEN    1
"""


@dataclass(frozen=True, slots=True, kw_only=True)
class Waiting:
    """The wall-clock times (s) of repetitions of one task."""

    what: str
    seconds: tuple[float, ...]
    target: float
    """Greatest permitted median (s)."""

    @property
    def median(self) -> float:
        """The median of the times (s)."""
        return median(self.seconds)

    @property
    def is_short(self) -> bool:
        """True if the target is met."""
        return self.median < self.target

    def as_json(self) -> dict[str, object]:
        """Return the times and their target, in seconds."""
        return {
            "what": self.what,
            "median_wall_s": self.median,
            "target_wall_s": self.target,
            "met": self.is_short,
            "each_wall_s": self.seconds,
        }


def measure(times: int) -> Iterator[Waiting]:
    """Measure each task `times` times.

    The keystrokes extend a name, so after each key the text has no error, and all of it must be checked.
    """
    check = [_seconds(partial(_check, script(LINES, k))) for k in range(times)]
    yield Waiting(what=f"{LINES} lines checked", seconds=tuple(check), target=0.025)
    text = script(TYPED_LINES, times)
    save = text.count("\n", 0, text.index("SAVE", len(text) // 2)) + 1
    strokes = typed(text, save, times)
    yield Waiting(what=f"a keystroke in {TYPED_LINES} lines", seconds=tuple(strokes), target=0.050)
    file = default_script()
    source, taught = read_source(file), load_taught(file.with_suffix(".toml"))
    plan = [_seconds(partial(_plan, source, _moved(taught, k))) for k in range(times)]
    yield Waiting(what=f"{task().words.product} planned", seconds=tuple(plan), target=1.0)


def script(lines: int, number: int) -> str:
    """Return a correct script with a number of lines (a multiple of 25). No line is the same for two values of
    `number`.
    """
    return "".join(
        _BLOCK.format(
            name=f"{number}_{k}",
            x=18 + number * 0.007 + k * 0.01,
            y=40 - number * 0.003 - k * 0.01,
            force=31 + (number + k) % 29,
            depth=500 + (7 * number + k) % 200,
        )
        for k in range(lines // _BLOCK.count("\n"))
    )


def _seconds(work: Callable[[], object]) -> float:
    begun = time.perf_counter()
    work()
    return time.perf_counter() - begun


def _check(text: str) -> None:
    """Check a text as `handeye check` and an editor do, without the arm's reach."""
    program, _ = compile_text(Source(name="pins.al", text=text), Taught())
    assert program is not None


def _plan(source: Source, taught: Taught) -> None:
    assert plan_source(source, taught, task().arm, AL, task=task().name).plan is not None


def _moved(taught: Taught, times: int) -> Taught:
    """Return the same positions, each shifted by a thousandth of a millimetre for each repetition."""

    def moved(position: Position) -> Position:
        x, *rest = position.at
        return replace(position, at=(x + times * 1e-6, *rest))

    return replaced(taught, positions={name: moved(p) for name, p in taught.positions.items()})
