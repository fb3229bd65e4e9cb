"""Reads events: the kinds of events that all systems have, and the kinds that the system of the run adds."""

from functools import cache, reduce
from operator import or_
from typing import Any, Final, get_args

import msgspec

from handeye.core.diagnostics import quoted
from handeye.core.entries import entries, loaded
from handeye.core.errors import BadArgument
from handeye.core.packed import decoded
from handeye.program.events import AnyEvent, CommonEvent, RunStarted, SystemEvent

_COMMON: Final = {kind.__name__ for kind in get_args(CommonEvent)}


def own_kinds(system: str) -> tuple[type[SystemEvent], ...]:
    """Return the kinds of events that a system adds, or an empty tuple if handeye does not know the system."""
    entry = entries().get(system)
    return _at(entry.events) if entry is not None and entry.events else ()


@cache
def _at(place: str) -> tuple[type[SystemEvent], ...]:
    """Load the kinds of events at `module:NAME`. Raises InvalidInput if these kinds cannot be loaded, or if their
    events cannot be written as JSON and read back.
    """
    own: tuple[type[SystemEvent], ...] = loaded(place)
    try:
        taken = _COMMON & {kind.__name__ for kind in own}
        if not taken:
            _decoder(tuple(own))
            msgspec.json.schema(_union(tuple(own)))
    except Exception as error:
        raise BadArgument(f"{place} cannot be loaded: {type(error).__name__}: {error}") from error
    if taken:
        raise BadArgument(f"{place} defines a kind of event with the reserved name {min(taken)}")
    return tuple(own)


def event_type(system: str) -> Any:
    """Return the msgspec type of all events of a system."""
    return _union(own_kinds(system))


@cache
def _union(own: tuple[type[SystemEvent], ...]) -> Any:
    return reduce(or_, own, CommonEvent)


@cache
def _decoder(own: tuple[type[SystemEvent], ...] = ()) -> msgspec.json.Decoder[AnyEvent]:
    return msgspec.json.Decoder(_union(own))


class EventReader:
    """Reads the events of one run in order. The system in `RunStarted` determines which kinds of events can follow."""

    def __init__(self, system: str = "") -> None:
        self.system = system

    def read(self, data: bytes) -> AnyEvent:
        """Read the event in one line of JSON. Raises msgspec.DecodeError if the line is no event of a known kind."""
        try:
            event = self._decoded(data)
        except UnicodeDecodeError as error:
            raise msgspec.DecodeError(str(error)) from None
        except RecursionError:
            raise msgspec.DecodeError("nested too deeply") from None
        if isinstance(event, RunStarted):
            self.system = event.system
        return event

    def _decoded(self, data: bytes) -> AnyEvent:
        try:
            return _decoder().decode(data)
        except msgspec.ValidationError:
            try:
                return _decoder(own_kinds(self.system)).decode(data)
            except msgspec.ValidationError:
                _refuse_unknown([msgspec.json.decode(data)], self.system)
                raise


def read_packed(data: msgspec.Raw, system: str) -> tuple[AnyEvent, ...]:
    """Read events of a system's run from MessagePack. Raises ValueError if the data are invalid, or if an event is of
    an unknown kind.
    """
    kind: Any = tuple.__class_getitem__((event_type(system), ...))
    try:
        events: tuple[AnyEvent, ...] = decoded(data, kind)
        return events
    except ValueError:
        _refuse_unknown(decoded(data, list), system)
        raise


def _refuse_unknown(plain: list[Any], system: str) -> None:
    """Raise msgspec.ValidationError if an event is of an unknown kind. The message names this kind."""
    known = _COMMON | {kind.__name__ for kind in own_kinds(system)}
    for event in plain:
        kind = event.get("event") if isinstance(event, dict) else None
        if isinstance(kind, str) and kind not in known:
            why = (
                "the events come from another version of handeye, or from another version of the system that wrote "
                "them"
            )
            if system and system not in entries():
                why = f"the system {quoted(system)} is not installed"
            raise msgspec.ValidationError(f"events of the kind {quoted(kind)} are unknown here: {why}")
