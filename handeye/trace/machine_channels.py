"""What the channels of machines showed in a servo period, as JSON."""

from typing import Final

import msgspec

from handeye.core.record import Record
from handeye.ports.axes import Channel
from handeye.ports.workcell import Sensed
from handeye.trace.hand_message import in_one_piece, rounded


class ChannelValues(Channel, frozen=True, kw_only=True, omit_defaults=True):
    """A channel and its values."""

    values: tuple[float, ...]


class ChannelsMessage(Record, frozen=True, kw_only=True):
    """The channels of all machines at the end of a servo period."""

    channels: tuple[ChannelValues, ...]


_encoder: Final = msgspec.json.Encoder()
_decoder: Final = msgspec.json.Decoder(ChannelsMessage)


def channels_message(sensed: Sensed) -> bytes:
    """The message for a servo period."""
    told = [
        ChannelValues(**msgspec.structs.asdict(channel), values=tuple(map(rounded, values)))
        for channel, values in sensed.channels.items()
    ]
    return _encoder.encode(ChannelsMessage(channels=tuple(told)))


def channels_schema() -> bytes:
    """JSON schema of the messages."""
    return in_one_piece(ChannelsMessage)


def decoded_channels(data: bytes) -> tuple[ChannelValues, ...]:
    """The channels of the message in some bytes; raises DecodeError if it is none."""
    return _decoder.decode(data).channels
