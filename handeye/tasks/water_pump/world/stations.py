"""Stations of the pump's table: fixtures in which parts and tools wait, or against which they are pushed.

A station made of boxes needs only one entry `[stations.NAME]` in `scenes/water_pump/dimensions.toml`. The scene then
shows the station. In each world, the station has a different position error. The planner keeps every motion clear of
the station.
"""

from enum import StrEnum

from handeye.core.errors import BadFile
from handeye.core.obb import Box
from handeye.program.program import Fixture
from handeye.tasks.stanford_cell.dimensions import dimensions


class Station(StrEnum):
    """Names of the stations that do not consist only of boxes. The body and the error of each station have the same
    name as the station.
    """

    BLOCKS = "blocks"
    PIN_HOLDER = "pin_holder"
    GASKET_STAND = "gasket_stand"
    TOP_STAND = "top_stand"
    RACK = "rack"
    DISPENSER = "dispenser"


def plain_stations() -> dict[str, tuple[Box, ...]]:
    """Return the boxes of each station that consists only of boxes, in the table frame (m). The keys are the names of
    the stations. Raises InvalidInput if a station's figures do not describe boxes.
    """
    found = {}
    for figure in dimensions().figures:
        group, _, rest = figure.partition(".")
        if group == "stations":
            found[rest.removesuffix(".boxes")] = _boxes(figure)
    return found


def _boxes(figure: str) -> tuple[Box, ...]:
    values = iter(dimensions().all(figure))
    try:
        boxes = tuple(zip(*[values] * 6, strict=True))
    except ValueError:
        boxes = ()
    if not boxes or not all(low < high for b in boxes for low, high in zip(b[:3], b[3:], strict=True)):
        raise BadFile(
            f"the dimension `{figure}` must be a list of boxes, each given by six numbers: x, y and z of its low "
            "corner, then x, y and z of its high corner"
        )
    return boxes


def stations() -> tuple[str, ...]:
    """Return the names of all stations."""
    return (*Station, *plain_stations())


def planned_fixtures() -> dict[str, Fixture]:
    """Return the obstacles for the planner: the stations that consist only of boxes. The keys are the names of the
    stations in taught files.
    """
    origin = (0.0, 0.0, 0.0, 0.0)
    return {name.upper(): Fixture(at=origin, boxes=boxes) for name, boxes in plain_stations().items()}
