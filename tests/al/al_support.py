"""What the language tests share: a few taught names, and functions that compile a program and follow its steps."""

from collections.abc import Mapping, Sequence
from types import MappingProxyType

import msgspec

from handeye import al
from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source
from handeye.program.flow_operations import Assign, Countdown, Test
from handeye.program.motion_operations import Move
from handeye.program.program import Hole, Part, Position, Program
from handeye.program.taught import Taught

ORIGIN = Position(at=(0.0, 0.0, 0.0, 0.0, 0.0, 0.0))
TAUGHT = Taught(
    positions=dict.fromkeys(("P", "T", "PARK"), ORIGIN),
    parts={
        "BASE": Part(
            at=(0.0, 0.0, 0.0, 0.0),
            holes=(Hole(x=0.0, y=0.0, diameter=0.05), Hole(x=0.07, y=0.0, diameter=0.03)),
            region=(0.1, 0.1),
            outline=(-0.05, -0.05, 0.1, 0.05),
        ),
        "GASKET": Part(at=(0.0, 0.0, 0.0, 0.0)),
    },
)

LISTING = """\
        MOVE  P              ;GO TO THE PIN
        CLOSE 0.1            ;grasp it
        MOVE  T              ;GO TO THE HOLE
        SEARCH .07           ;
L1:     MOVE  T              ;GO TO THE HOLE
        STOP  [0 0 -50]      ;
        CHANGE [0 0 -1] 0.6  ;TRY TO GO DOWN WITHOUT MEETING RESISTANCE
        SKIPE 23             ;
        AOJ   L1             ;
        STOP  [0 0 -60]      ;
        CHANGE [0 0 -1] 0.6  ;IT SHOULD MEET SOME RESISTANCE
        SKIPN 23             ;
        AOJ   L1             ;
        SAVE  H              ;
        OPEN  .5             ;
        CLOSE 0.1            ;AND CHECK THAT IT IS STILL THERE
        OPEN  1              ;or WAIT 1
"""
"""The pin insertion of 1973, as restored."""


def diagnose(text: str, files: Mapping[str, str] = MappingProxyType({})) -> list[Diagnostic]:
    return al.compile_text(al.sewn_of(Source(name="test.al", text=text), files), TAUGHT)[1]


def codes(text: str, files: Mapping[str, str] = MappingProxyType({})) -> list[str]:
    return [diagnostic.code for diagnostic in diagnose(text, files)]


def compiled(text: str) -> Program:
    program, diagnostics = al.compile_text(Source(name="plans/test.al", text=text), TAUGHT)
    assert program is not None, diagnostics
    return program


def only(text: str, kind: type) -> object:
    """The one operation of a kind."""
    (found,) = [s.operation for s in compiled(text).steps if isinstance(s.operation, kind)]
    return found


def walk(program: Program, raised: Mapping[str, Sequence[int | None]]) -> list[str]:
    """Return the statements in the order in which the compiler's graph leads to them, if each raises the given errors,
    one at each visit. This tests the compiler, not the executor.
    """
    errors = {text: list(numbers) for text, numbers in raised.items()}
    trace: list[str] = []
    error: int | None = None
    counters: dict[str, int] = {}
    at: int | None = 0 if program.steps else None
    while at is not None and len(trace) < 1000:
        step = program.steps[at]
        trace.append(step.text)
        at = step.next
        if step.operation.raising:
            queue = errors.get(step.text)
            error = queue.pop(0) if queue else None
        elif isinstance(step.operation, Test) and error == step.operation.number:
            error, at = None, step.operation.raised
        elif isinstance(step.operation, Assign):
            counters[step.operation.counter] = step.operation.value
        elif isinstance(step.operation, Countdown):
            counters[step.operation.counter] -= 1
            at = step.operation.positive if counters[step.operation.counter] > 0 else at
    return trace


_WHERE = ("span", "start", "end", "line")


def said(tree: object) -> object:
    """Return the content of a syntax tree, without its places in the text."""
    if isinstance(tree, tuple):
        return tuple(map(said, tree))
    if isinstance(tree, dict):
        return {name: said(part) for name, part in tree.items()}
    if isinstance(tree, msgspec.Struct):
        parts = msgspec.structs.asdict(tree)
        return type(tree), {name: said(part) for name, part in parts.items() if name not in _WHERE}
    return tree


def moves(program: Program) -> list[Move]:
    return [step.operation for step in program.steps if isinstance(step.operation, Move)]
