"""The command of the safety study."""

from typing import Annotated, Literal

from cyclopts import Parameter

from handeye.cli.common import Json, say
from handeye.systems.sigma.cli.studies import put_study


def crash(
    *,
    speed: Annotated[
        float | None,
        Parameter(help="Constant speed of arm 1, 2 to 254 mm/s; without it, arm 1 moves as fast as it can."),
    ] = None,
    reflex: Annotated[
        Literal["on", "off"], Parameter(help="Whether the wires from the wrists to the motors are connected.")
    ] = "on",
    endless_loop: Annotated[
        bool,
        Parameter(
            negative=(),
            help="After sending the move, the central computer hangs and no longer reads the status of the motors.",
        ),
    ] = False,
    lower: Annotated[
        Literal["none", "1", "2"],
        Parameter(
            help="The arm whose hand is 100 mm lower than the other's. `2`: the hand of arm 1 hits the column of "
            "arm 2. `1`: the column of arm 1 hits the hand of arm 2. `none`: the hands meet."
        ),
    ] = "none",
    json: Json = False,
) -> int:
    """Let arm 1 run into the stationary hand of arm 2, and compare what the program believes with what is true.

    The collision is a study, so no outcome is right or wrong. The page `docs/safety_study.md` compares fourteen
    collisions.

    Exit code 0: simulated; 2: bad input.
    """
    from handeye.systems.sigma.gantries.crash import crash as collide
    from handeye.systems.sigma.gantries.crash import lines

    found = collide(
        speed, reflex=reflex == "on", endless_loop=endless_loop, lower=0 if lower == "none" else int(lower)
    )
    if json:
        put_study("crash", found, completed=True, message=found.message)
    else:
        for line in lines(found):
            say(line, whole=True)
    return 0
