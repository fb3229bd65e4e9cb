"""The command that studies one axis."""

from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import Json, WholeNumber, say, screen
from handeye.core.errors import BadArgument
from handeye.systems.sigma.cli.bus import NO_DRAWING, DrawingOptions
from handeye.systems.sigma.cli.studies import put_study


def axis(
    *,
    mass: Annotated[
        float,
        Parameter(help="Mass that the motor moves, in kg. In SUPERSIGMA: 12 for X, 8 for Y and 2.5 for Z."),
    ] = 12.0,
    steps: Annotated[WholeNumber, Parameter(help="Length of the move, in steps of 0.0375 mm.")] = 8000,
    curve: Annotated[
        WholeNumber,
        Parameter(
            help="Acceleration curve. Curve 0 is the usual one, with a top speed of 13333 steps/s. Curve 1 has a "
            "top speed of 15000 steps/s. Curve 2 accelerates half as fast as curve 0, and curve 3 a quarter as "
            "fast. Curve 4 has half the start/stop speed of curve 0."
        ),
    ] = 0,
    slow: Annotated[
        float | None,
        Parameter(help="Constant speed, in mm/s. Above 37.5 mm/s, the move begins and ends with ramps."),
    ] = None,
    load: Annotated[float, Parameter(help="Force against the motion, in N.")] = 0.0,
    stop_after: Annotated[
        float | None, Parameter(help="Make an emergency stop after this time, in ms.")
    ] = None,
    cut: Annotated[
        bool,
        Parameter(
            negative=(),
            help=(
                "Stop the motor by sending no more pulses. Without this option, the motor stops along the steepest "
                "ramp."
            ),
        ),
    ] = False,
    json: Json = False,
    drawing: DrawingOptions = NO_DRAWING,
) -> int:
    """Simulate one move of one motor. Show the speed of the motor, the force that the move requires, and whether the
    rotor follows or slips.

    Exit code 0: no step was lost; 1: steps were lost; 2: bad input.
    """
    from handeye.systems.sigma.motors.drawing import as_svg, as_text
    from handeye.systems.sigma.motors.study import lines, study, verdict

    if cut and stop_after is None:
        raise BadArgument("--cut applies only to an emergency stop: give --stop-after too")
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
        put_study("axis", found, completed=found.kept, message="; ".join(verdict(found)))
    else:
        for line in (*as_text(found, screen.width), "", *lines(found)):
            say(line, whole=True)
    return 0 if found.kept else 1
