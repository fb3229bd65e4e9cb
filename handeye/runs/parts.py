"""Parts of a run, such as the search pattern or the camera, that the caller's own code can replace.

Checkpoints and traces cannot store code, only its name. A run that was begun with a replaced part can therefore
continue only with a part of the same name.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, Any, Final

from handeye.core.errors import Refused
from handeye.touch.spiral import SearchPattern

if TYPE_CHECKING:
    from handeye.cell.rendering import RendererMaker

VISION: Final = ("GENERAL", "SPECIFIC", "INSPECT")  # instructions behind which a caller can put a function
NEEDED: Final = (
    "search",
    "camera",
    *VISION,
)  # parts that determine the course of a run; the referee does not


VisionFunction = Callable[..., Any]  # see `handeye.begin`


@dataclass(frozen=True, slots=True, kw_only=True)
class Parts:
    """Replacements for the parts that determine the course of a run. If a field is None, handeye's own part is used."""

    search: SearchPattern | None = None  # the places that a search tries
    camera: RendererMaker | None = None  # maker of pictures
    vision: Mapping[str, VisionFunction] = field(default_factory=dict)  # by instruction; see `VISION`

    @property
    def names(self) -> dict[str, str]:
        """The names of the caller's code. The keys are the parts that this code replaces."""
        found: dict[str, Any] = {"search": self.search, "camera": self.camera, **self.vision}
        return {part: name_of(code) for part, code in found.items() if code is not None}

    def check(self, begun: dict[str, str]) -> None:
        """Raise Refused if a run was begun with other parts. `begun` gives the names of those parts."""
        here = self.names
        for part in NEEDED:
            was, now = begun.get(part), here.get(part)
            if was is not None and now is None:
                raise Refused(
                    f"the run uses a {part} of the calling program, `{was}`, whose code is not saved in the run; in "
                    f"Python, pass `{was}` to `handeye.begin` as {given_as(part)}"
                )
            if was != now:
                before = f"handeye's own {part}" if was is None else f"`{was}` as its {part}"
                raise Refused(f"the run began with {before}, but `{now}` was given")


def given_as(part: str) -> str:
    """Return the argument of `handeye.begin` with which a caller replaces a part."""
    return f"vision={{{part!r}: ...}}" if part in VISION else f"{part}=..."


def deciding(names: dict[str, str]) -> dict[str, str]:
    """Return those replaced parts that determine the course of a run."""
    return {part: names[part] for part in NEEDED if part in names}


def named(names: dict[str, str]) -> str:
    """Return the replaced parts that determine the course of a run, as words for a message."""
    return ", ".join(f"{part} {name}" for part, name in deciding(names).items()) or "only handeye's own code"


def name_of(code: Any) -> str:
    """Return the name of a function or class, preceded by the name of its module. For any other object, return the
    name of its class in the same way.
    """
    named = code if hasattr(code, "__qualname__") else type(code)
    return f"{named.__module__}.{named.__qualname__}"


OWN: Final = Parts()  # all parts are handeye's own
