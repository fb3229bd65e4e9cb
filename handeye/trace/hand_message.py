"""Encodes servo periods as JSON messages. The JSON messages contain what no typed message covers: force, finger gap
and guards of the hand, and the channels of machines.
"""

from typing import Annotated, Any, Final

import msgspec
import numpy as np
from msgspec import UNSET, UnsetType

from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.execution.servo import ServoPeriod
from handeye.ports.axes import Channel
from handeye.ports.workcell import Sensed
from handeye.program.guards import GuardKind
from handeye.touch.guards import ActiveGuard

PLACES: Final = 6  # decimals of all figures, as in the event of a tripped guard: a micrometre, a micronewton


class Axes(Record, frozen=True, kw_only=True):
    """A vector in world axes."""

    x: float
    y: float
    z: float

    def array(self) -> Array:
        return np.array([self.x, self.y, self.z])


class GuardMessage(Record, frozen=True, kw_only=True):
    """A guard that watches a motion in this servo period."""

    guard: Annotated[GuardKind, msgspec.Meta(extra_json_schema={"type": "string"})]
    limit: float  # N, N m, or finger switches as a mask
    axis: Axes | UnsetType = UNSET  # unit vector along or about which it watches a force or moment


class HandMessage(Record, frozen=True, kw_only=True, omit_defaults=True):
    """Force, gap and guards of the hand at the end of a servo period."""

    estimated: bool  # True if force and moment are estimated; otherwise both are missing
    force: Axes | UnsetType = UNSET  # force that the hand exerts on the world, N
    moment: Axes | UnsetType = (
        UNSET  # moment that the hand exerts on the world, about its tool centre point, N m
    )
    gap: float  # opening of the fingers, m
    finger_1: bool  # the switch in the finger on the +y side of the hand frame
    finger_2: bool  # the switch in the other finger
    driver_torque: float  # torque of the screwdriver's motor, computed from its current, N m
    guards: tuple[GuardMessage, ...] = ()


_encoder: Final = msgspec.json.Encoder()
_decoder: Final = msgspec.json.Decoder(HandMessage)


def hand_message(period: ServoPeriod) -> bytes:
    """Encode the hand message of a servo period."""
    sensed, felt = period.sensed, period.wrench
    message = HandMessage(
        estimated=felt is not None,
        force=UNSET if felt is None else _axes(felt[:3]),
        moment=UNSET if felt is None or not felt[3:].size else _axes(felt[3:]),
        gap=rounded(sensed.gap),
        finger_1=sensed.touch[0],
        finger_2=sensed.touch[1],
        driver_torque=rounded(sensed.tool_torque),
        guards=tuple(map(_guard, period.guards)),
    )
    return _encoder.encode(message)


def read_hand(data: bytes) -> HandMessage:
    """Decode a hand message. Raises msgspec.DecodeError if the data are not a hand message."""
    return _decoder.decode(data)


def hand_schema() -> bytes:
    return in_one_piece(HandMessage)


def in_one_piece(kind: type[Record]) -> bytes:
    """Return the JSON schema of a record. The schema has no internal references, because some tools do not follow
    them.
    """
    whole = msgspec.json.schema(kind)
    return msgspec.json.encode(_in_place(whole, whole["$defs"]), order="sorted")


def _in_place(schema: Any, defined: dict[str, Any]) -> Any:
    """Return the schema with each reference replaced by its definition."""
    match schema:
        case {"$ref": str(name)}:
            return _in_place(defined[name.rsplit("/", 1)[-1]], defined)
        case dict():
            return {key: _in_place(inner, defined) for key, inner in schema.items() if key != "$defs"}
        case list():
            return [_in_place(inner, defined) for inner in schema]
    return schema


def _guard(active: ActiveGuard) -> GuardMessage:
    axis = UNSET if active.axis is None else _axes(active.axis)
    return GuardMessage(guard=active.guard, limit=rounded(active.limit), axis=axis)


def _axes(vector: Array) -> Axes:
    x, y, z = vector.tolist()
    return Axes(x=rounded(x), y=rounded(y), z=rounded(z))


def rounded(value: float) -> float:
    return round(value, PLACES) + 0.0  # no negative zero


class ChannelValues(Channel, frozen=True, kw_only=True, omit_defaults=True):
    """A channel with its values."""

    values: tuple[float, ...]


class ChannelsMessage(Record, frozen=True, kw_only=True):
    """The channels of all machines at the end of a servo period."""

    channels: tuple[ChannelValues, ...]


_channels_encoder: Final = msgspec.json.Encoder()
_channels_decoder: Final = msgspec.json.Decoder(ChannelsMessage)


def channels_message(sensed: Sensed) -> bytes:
    """Encode the channels message of a servo period."""
    told = [
        ChannelValues(**msgspec.structs.asdict(channel), values=tuple(map(rounded, values)))
        for channel, values in sensed.channels.items()
    ]
    return _channels_encoder.encode(ChannelsMessage(channels=tuple(told)))


def channels_schema() -> bytes:
    return in_one_piece(ChannelsMessage)


def decoded_channels(data: bytes) -> tuple[ChannelValues, ...]:
    """Decode a channels message. Raises DecodeError if the data are not a channels message."""
    channels = _channels_decoder.decode(data).channels
    if any(channel.width != len(channel.values) for channel in channels):
        raise msgspec.DecodeError(
            "the number of values in a channel differs from the number that the channel declares"
        )
    return channels
