"""Stations of the pump's table: fixtures that parts and tools wait on, or are pushed against.

A station whose shape is boxes is one entry of `scenes/water_pump/dimensions.toml`, `[stations.NAME]`: the scene draws
it, worlds place it with an error of its own, and the planner keeps every motion clear of it.
"""

from enum import StrEnum

from handeye.core.errors import BadFile
from handeye.core.obb import Box
from handeye.program.program import Fixture
from handeye.tasks.stanford_cell.dimensions import dimensions


class Station(StrEnum):
    """Names of the stations with a shape of their own: of their bodies, and of the errors with which they stand."""

    BLOCKS = "blocks"
    PIN_HOLDER = "pin_holder"
    GASKET_STAND = "gasket_stand"
    TOP_STAND = "top_stand"
    RACK = "rack"
    DISPENSER = "dispenser"


def plain_stations() -> dict[str, tuple[Box, ...]]:
    """The boxes of the stations that are no more than boxes, by name; table frame, m. Raises InvalidInput if the
    figures of one are not those of boxes."""
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
            f"the dimension `{figure}` must be a list of boxes, each with x, y and z of its low and of its high corner"
        )
    return boxes


def stations() -> tuple[str, ...]:
    """Names of all stations."""
    return (*Station, *plain_stations())


def planned_fixtures() -> dict[str, Fixture]:
    """The plain stations as the planner keeps clear of them, by names as in a taught file."""
    origin = (0.0, 0.0, 0.0, 0.0)
    return {name.upper(): Fixture(at=origin, boxes=boxes) for name, boxes in plain_stations().items()}
