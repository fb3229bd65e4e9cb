"""The command that studies one axis."""

from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import Json, WholeNumber, put_json, say, screen
from handeye.systems.sigma.cli.bus import NO_DRAWING, DrawingOptions


def axis(
    *,
    mass: Annotated[
        float, Parameter(help="kg that the motor moves: 12 (X), 8 (Y) and 2.5 (Z) in SUPERSIGMA.")
    ] = 12.0,
    steps: Annotated[WholeNumber, Parameter(help="Length of the move; a step is 0.0375 mm.")] = 8000,
    curve: Annotated[
        WholeNumber,
        Parameter(
            help="0: up to 13333 steps/s; 1: up to 15000; 2 and 3: half and a quarter of the acceleration; 4: half of "
            "the start/stop speed."
        ),
    ] = 0,
    slow: Annotated[
        float | None, Parameter(help="Constant speed, mm/s; above 37.5 it begins and ends with ramps.")
    ] = None,
    load: Annotated[float, Parameter(help="Force against the motion, N.")] = 0.0,
    stop_after: Annotated[
        float | None, Parameter(help="Have an emergency stop the motor after this time, in ms.")
    ] = None,
    cut: Annotated[
        bool, Parameter(negative=(), help="Stop by leaving the pulses out, and not by the steepest ramp.")
    ] = False,
    json: Json = False,
    drawing: DrawingOptions = NO_DRAWING,
) -> int:
    """Make one move of one motor: its pulses, the force that they ask for, and whether the rotor follows or slips.

    Exit code 0: no step was lost; 1: some were; 2: bad input.
    """
    from handeye.systems.sigma.motors.drawing import as_svg, as_text
    from handeye.systems.sigma.motors.study import lines, study

    drawing.check()
    found = study(
        mass=mass,
        steps=steps,
        curve=curve,
        slow=slow,
        load=load,
        stop_after=None if stop_after is None else stop_after / 1000,
        cut=cut,
    )
    drawing.write(as_svg(found))
    if json:
        put_json(found)
    else:
        for line in (*as_text(found, screen.width), "", *lines(found)):
            say(line, whole=True)
    return 0 if found.kept else 1
