"""What the planner says about short scripts, in a cell with a stand and a stick."""

from handeye.al import AL, compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source
from handeye.core.units import DEGREE, INCH
from handeye.planning.planner import plan_program
from handeye.program.program import Fixture, Held, Position
from handeye.program.taught import Taught


def place(x: float, y: float, z: float) -> Position:
    """A hand that points down, finger line along y; inches."""
    return Position(at=(x * INCH, y * INCH, z * INCH, 90 * DEGREE, 90 * DEGREE, 0.0))


CELL = Taught(
    positions={
        "T": place(25, 38, 4),
        "PEG": place(14, 36, 2),
        "OVER": place(32, 46, 2),
        "WEST": place(27, 46, 1),
        "EAST": place(37, 46, 1),
    },
    fixtures={
        "STAND": Fixture(
            at=(32 * INCH, 46 * INCH, 0.0, 0.0),
            boxes=((-2 * INCH, -2 * INCH, 0.0, 2 * INCH, 2 * INCH, 1.75 * INCH),),
        )
    },
    held={
        "STICK": Held(
            positions=("PEG",),
            boxes=((-0.2 * INCH, -0.2 * INCH, -0.5 * INCH, 0.2 * INCH, 0.2 * INCH, 1.5 * INCH),),
        )
    },
)


def said(text: str) -> list[Diagnostic]:
    """What the planner says."""
    program, diagnostics = compile_text(Source(name="test.al", text=text), CELL)
    assert program is not None, diagnostics
    return plan_program(program, STANFORD, AL)[1]


def message(text: str) -> str:
    """The one thing it says: code and message."""
    (problem,) = said(text)
    return f"{problem.code}: {problem.message}"
