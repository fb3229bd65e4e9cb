"""The channels of the real-time level: what the tables of motors and sensors hold in each cycle, in ML units."""

from collections.abc import Mapping

from handeye.ports.axes import Channel
from handeye.systems.ml.level import Side
from handeye.systems.ml.realtime.level import RealTime
from handeye.systems.ml.tables.layout import MOTORS, SENSORS

_OF_MOTORS = ("position", "strategic", "tactical")
_OF_SENSORS = ("reading", "flag")


def level_channels(levels: Mapping[Side, RealTime]) -> tuple[Channel, ...]:
    """Return the channels of all arms. Each channel has one part per motor or sensor, in ascending order of their
    numbers.
    """
    return tuple(
        Channel(name=_named(name, side, len(levels)), width=width)
        for side in levels
        for names, width in ((_OF_MOTORS, MOTORS), (_OF_SENSORS, SENSORS))
        for name in names
    )


def level_values(levels: Mapping[Side, RealTime]) -> dict[Channel, tuple[float, ...]]:
    """Return the present values of the channels."""
    values = [
        tuple(float(getattr(line, name)) for line in table)
        for level in levels.values()
        for names, table in ((_OF_MOTORS, level.memory.MT), (_OF_SENSORS, level.memory.ST))
        for name in names
    ]
    return dict(zip(level_channels(levels), values, strict=True))


def _named(name: str, side: Side, sides: int) -> str:
    return name if sides == 1 else f"{side}.{name}"
