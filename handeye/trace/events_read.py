"""Events as traces and event lists hold them, those of an older handeye brought up to date."""

import re
from typing import Any, Final

import msgspec

from handeye.program.events import AnyEvent

_DECODER: Final[msgspec.json.Decoder[AnyEvent]] = msgspec.json.Decoder(AnyEvent)


def read_event(data: bytes) -> AnyEvent:
    """The event in some JSON.

    Raises:
        msgspec.DecodeError: it is none.
        UnicodeDecodeError: it is no text.
    """
    try:
        return _read(data)
    except RecursionError:
        raise msgspec.DecodeError("it is nested too deeply") from None


def _read(data: bytes) -> AnyEvent:
    try:
        return _DECODER.decode(data)
    except msgspec.ValidationError:
        written = msgspec.json.decode(data)
        if not isinstance(written, dict) or not _bring_up_to_date(written):
            raise
        return _DECODER.decode(msgspec.json.encode(written))


def _bring_up_to_date(event: dict[str, Any]) -> bool:
    """Write an event as it would be written today; False: there is nothing to be done."""
    match event:
        case {"event": "RunStarted", "seed": seed}:
            del event["seed"]
            event["world"] = {"seed": seed, "drawing": 1}  # one generator in a fixed order, no level
            event["camera"] = _renderer(str(event.get("camera")))
        case {"event": "ErrorRaised", "detail": words}:
            del event["detail"]
            event["cause"] = _recorded(words)
        case {"event": "PartInspected", "sentence": words, "ok": ok}:
            del event["sentence"]
            event["cause"] = None if ok is True else _recorded(words)
        case _:
            return False
    return True


def _recorded(words: Any) -> dict[str, Any] | None:
    """The words of an older handeye in the place of a cause; none: it said nothing."""
    return None if words == "" else {"cause": "Recorded", "words": words}


def _renderer(name: str) -> dict[str, str]:
    """How pictures are made, by the name that an older handeye wrote: `OpenGL (EGL)`, `ray casting`."""
    opengl = re.fullmatch(r"OpenGL \((.*)\)", name)
    if opengl is not None:
        return {"method": "opengl", "platform": opengl[1]}
    return {"method": "rays" if name == "ray casting" else "none"}
