"""The command of the bridge, which turns a MAL program into a plan for another arm."""

from pathlib import Path
from typing import Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import Overwrite, TaskWords, say, show
from handeye.core.errors import BadArgument

MalFile = Annotated[Path, Parameter(help="A MAL program (`.mal`) with a single task.")]
BoardCorner = Annotated[
    tuple[float, float] | None,
    Parameter(
        help="Where the board's corner X1 = 0, Y1 = 0 lies on the table: x and y, in millimetres. Default: 350 550."
    ),
]
_FARTHEST: Final = 10_000.0  # mm


def board_corner(at: tuple[float, float] | None) -> tuple[float, float]:
    """Return the place of the board's corner (mm). Raises BadArgument if a coordinate is not a number, or the place is
    too far from the arm.
    """
    from handeye.systems.sigma.bridge.translation import AT

    for each in at or ():
        if not abs(each) <= _FARTHEST:
            raise BadArgument(f"--at must be between -{_FARTHEST:g} and {_FARTHEST:g} mm, not {each:g}")
    return at or AT


def bridge(
    file: MalFile,
    /,
    *,
    at: BoardCorner = None,
    task: TaskWords = None,
    output: Annotated[Path | None, Parameter(name=["--out", "-o"])] = None,
    overwrite: Overwrite = False,
) -> int:
    """Turn a MAL program into a plan for the Stanford arm. The program may use only MOVE, ORIGIN, LIMIT, SPEED,
    ACTUATE, ON ABORT, GOTO, END, STOP, REM, and tests of FORCE right after a MOVE.

    `handeye run` runs the plan. A program with a line that cannot become a motion is refused, and each such line is
    named.

    Exit code 0: written; 2: bad input, or a refused program.

    Parameters
    ----------
    output
        File for the plan. Default: next to the program, with the ending .plan.json. An earlier plan at the default
        place is replaced; to replace another file, give --overwrite.
    """
    from handeye import tasks
    from handeye.core.diagnostics import has_errors
    from handeye.core.files import beside, check_place
    from handeye.core.plain_text import counted
    from handeye.core.source import read_source
    from handeye.planfile.store import PLAN, write_plan
    from handeye.program.taught import Taught
    from handeye.runs.scripts import planned
    from handeye.systems.sigma.bridge import language

    corner = board_corner(at)
    source = read_source(file)
    work = tasks.task() if task is None else tasks.planned(tasks.named(task))
    made = planned(source, Taught(), work, language.bridge(corner))
    show(made.diagnostics, source, json=False)
    if made.plan is None or has_errors(made.diagnostics):
        return 2
    target = output or beside(file, ".plan.json")
    check_place(target, PLAN, overwrite=overwrite or output is None)
    write_plan(target, made.plan)
    program = made.plan.program
    told = ", ".join((counted(len(program.steps), "step"), counted(len(made.plan.motions), "motion")))
    say(f"{target}: {told}; the plan has only motions of the arm, and uses no bus")
    return 0
