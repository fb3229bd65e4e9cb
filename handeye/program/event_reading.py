"""Reads events back: the kinds that all systems have, and those that the system of the run adds."""

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
    """Kinds of events that a system adds; none if there is no such system here."""
    entry = entries().get(system)
    return _at(entry.events) if entry is not None and entry.events else ()


@cache
def _at(place: str) -> tuple[type[SystemEvent], ...]:
    """The kinds at `module:NAME`; raises InvalidInput if they cannot be loaded, written as JSON and read back."""
    own: tuple[type[SystemEvent], ...] = loaded(place)
    try:
        taken = _COMMON & {kind.__name__ for kind in own}
        if not taken:
            _decoder(tuple(own))
            msgspec.json.schema(_union(tuple(own)))
    except Exception as error:
        raise BadArgument(f"{place} cannot be loaded: {type(error).__name__}: {error}") from error
    if taken:
        raise BadArgument(f"{place} names a kind of event {min(taken)}, which is reserved")
    return tuple(own)


def event_type(system: str) -> Any:
    """The type of all events of a system, for msgspec."""
    return _union(own_kinds(system))


@cache
def _union(own: tuple[type[SystemEvent], ...]) -> Any:
    return reduce(or_, own, CommonEvent)


@cache
def _decoder(own: tuple[type[SystemEvent], ...] = ()) -> msgspec.json.Decoder[AnyEvent]:
    return msgspec.json.Decoder(_union(own))


class EventReader:
    """Reads the events of one run in order; which kinds there are it learns from `RunStarted`."""

    def __init__(self, system: str = "") -> None:
        self.system = system

    def read(self, data: bytes) -> AnyEvent:
        """The event in some JSON; raises msgspec.DecodeError if there is none, or of a kind that is not known."""
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
    """Events in MessagePack, of a run of a system; raises ValueError if they are none, or of an unknown kind."""
    kind: Any = tuple.__class_getitem__((event_type(system), ...))
    try:
        events: tuple[AnyEvent, ...] = decoded(data, kind)
        return events
    except ValueError:
        _refuse_unknown(decoded(data, list), system)
        raise


def _refuse_unknown(plain: list[Any], system: str) -> None:
    """Raise msgspec.ValidationError with a sentence if one of some events is of a kind that is not known."""
    known = _COMMON | {kind.__name__ for kind in own_kinds(system)}
    for event in plain:
        kind = event.get("event") if isinstance(event, dict) else None
        if isinstance(kind, str) and kind not in known:
            why = "they come from another version of handeye or of its system"
            if system and system not in entries():
                why = f"the system {quoted(system)} is not installed"
            raise msgspec.ValidationError(f"events of the kind {quoted(kind)} are unknown here: {why}")
