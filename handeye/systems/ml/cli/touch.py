"""The command that simulates the touch of a block, with a chosen period, bandwidth and speed."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import Json, Overwrite, WholeNumber, note, put_json, say
from handeye.core.errors import BadArgument


def touch(
    *,
    period: Annotated[
        WholeNumber | None,
        Parameter(
            help="Time from one reading of the sensors to the next, 1 to 100 ms. Default: 10, as in the paper."
        ),
    ] = None,
    bandwidth: Annotated[
        float | None, Parameter(help="Bandwidth of the servo, 5 to 120 Hz. Default: 50, as in the paper.")
    ] = None,
    speed: Annotated[float | None, Parameter(help="Speed of the slide, 1 to 200 mm/s. Default: 25.")] = None,
    limit: Annotated[
        WholeNumber,
        Parameter(
            help="The hand stops when the strain gauge in the right finger reads more than this limit, 10 to 1500 "
            "grams."
        ),
    ] = 300,
    phase: Annotated[
        float,
        Parameter(
            help="When in the period the contact occurs: 0 is just after the sensors are read, .99 just before they "
            "are read again."
        ),
    ] = 0.0,
    page: Annotated[
        Path | None,
        Parameter(
            help="Write a page (.html) with sliders for the period (2 to 50 ms), the bandwidth of the servo (10 to "
            "100 Hz) and the speed (5 to 200 mm/s). Writing the page takes about 10 s."
        ),
    ] = None,
    overwrite: Overwrite = False,
    json: Json = False,
) -> int:
    """Simulate a guarded touch on a block. Show how far the hand moves on after the contact, and with what force it
    presses.

    The hand descends until the reading of a strain gauge is beyond its limit. The simulation shows the effect of
    reading the sensors only every ten milliseconds, as MOS does: after the contact, the slide moves on until the
    sensors are read again. Then it moves on until its servo has caught up with the set-point.
    `docs/ten_milliseconds.md` has the figures.

    Exit code 0: simulated; 2: bad input.
    """
    from handeye.systems.ml.bench.touch import BANDWIDTH, PERIOD, SPEED, lines
    from handeye.systems.ml.bench.touch import touch as touched

    if page is not None:
        if json or any(each is not None for each in (period, bandwidth, speed)):
            raise BadArgument(
                "--page shows all periods, bandwidths and speeds; the only options that you can give with it are "
                "--limit and --overwrite"
            )
        return _page(page, limit, overwrite=overwrite)
    found = touched(
        PERIOD if period is None else period,
        BANDWIDTH if bandwidth is None else bandwidth,
        SPEED if speed is None else speed,
        limit,
        phase,
    )
    if json:
        put_json(found)
    else:
        for line in lines(found):
            say(line, whole=True)
    return 0


def _page(place: Path, limit: int, *, overwrite: bool) -> int:
    """Write the page of touches, and return the exit code. Raises InvalidInput if the page cannot be written."""
    from handeye.core.files import check_place, write_over
    from handeye.systems.ml.bench.touches import PAGE, swept, touches_page

    check_place(place, PAGE, overwrite=overwrite)
    note("simulating 480 touches")
    write_over(place, touches_page(swept(limit)), PAGE)
    say(f"{place}")
    return 0
