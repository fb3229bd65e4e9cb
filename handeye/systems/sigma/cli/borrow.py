"""The command that runs a MAL program with the Stanford arm in place of an arm of SUPERSIGMA."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import Json, WholeNumber, note, say
from handeye.systems.sigma.cli.bridge import BoardCorner, board_corner

MalFile = Annotated[Path, Parameter(help="A MAL program (`.mal`) for arm 1.")]


def borrow(
    file: MalFile,
    /,
    *,
    at: BoardCorner = None,
    seed: Annotated[
        WholeNumber, Parameter(help="Seed of the world: it determines the errors of the arm.")
    ] = 0,
    json: Json = False,
) -> int:
    """Run a MAL program with the Stanford arm in place of arm 1: X1, Y1 and Z1 move the tool of the Stanford arm, and
    there is no bus.

    The arm moves over the table of the water-pump cell. The greatest speed of the arm is 150 mm/s. Without LIMIT, no
    force stops the arm; after LIMIT, a force above the limit stops the arm within a servo period of 1/60 s. Programs
    that use arm 2, a light beam or a device other than HAND1 are refused. The run is not kept.

    Exit code 0: all tasks have ended; 1: the program stopped before its end; 2: bad input; 130: interrupted.
    """
    from handeye.cli.panic_button import PanicButton
    from handeye.core.source import read_source
    from handeye.core.variation import WorldSpec
    from handeye.execution.servo import Halted
    from handeye.systems.sigma.bridge.borrowed_arm import borrowed
    from handeye.systems.sigma.bridge.borrowed_run import SAID, check_program, lines, run_borrowed
    from handeye.systems.sigma.cli.commands import Printer, reported
    from handeye.systems.sigma.cli.studies import put_study
    from handeye.systems.sigma.mal.check import checked
    from handeye.systems.sigma.run.plan import MalPlan, sound

    spec, corner = WorldSpec(seed=seed), board_corner(at)
    source = read_source(file)
    if not reported(source):
        return 2
    plan = MalPlan(name=file.name, text=source.text)
    sound(plan)
    check_program(checked(source)[0])
    put = note if json else say
    put(SAID)
    printer = Printer(put)
    with PanicButton() as panic:

        def poll() -> None:
            if panic():
                raise Halted

        try:
            found = run_borrowed(plan.program, borrowed(spec, corner, poll), printer.event, poll)
        except Halted:
            raise KeyboardInterrupt from None
    if json:
        put_study("borrow", found, completed=found.completed, message=found.message, seed=seed)
    else:
        for line in lines(found):
            say(line)
    return 0 if found.completed else 1
