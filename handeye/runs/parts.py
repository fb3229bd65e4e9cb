"""Parts of a run that its caller's code takes the place of.

Code cannot be written into a checkpoint or a trace. What can is that it was there, and its name: a run that was begun
with such a part goes on only with a part of that name.
"""

from dataclasses import dataclass
from typing import Any, Final

from handeye.cell.rendering import RendererMaker
from handeye.core.errors import Refused
from handeye.touch.spiral import SearchPattern

NEEDED: Final = ("search", "camera")
"""Parts that decide a run; the referee decides nothing of it."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Parts:
    """Parts that decide a run, where they are not handeye's own."""

    search: SearchPattern | None = None
    """The places that a search tries."""
    camera: RendererMaker | None = None
    """Maker of pictures."""

    @property
    def names(self) -> dict[str, str]:
        """The name of each part that there is."""
        found = {"search": self.search, "camera": self.camera}
        return {part: name_of(code) for part, code in found.items() if code is not None}

    def check(self, begun: dict[str, str]) -> None:
        """Make sure that a run goes on with the parts it was begun with, given by their names.

        Raises:
            InvalidInput: it does not.
        """
        here = self.names
        for part in NEEDED:
            was, now = begun.get(part), here.get(part)
            if was is not None and now is None:
                raise Refused(
                    f"the run has a {part} of its own, `{was}`, which is code and is kept in no file; "
                    f"from Python, `handeye.begin` takes it as {part}=..."
                )
            if was != now:
                before = "handeye's own" if was is None else f"`{was}`"
                raise Refused(f"the run was begun with {before} as its {part}; `{now}` is another")


def deciding(names: dict[str, str]) -> dict[str, str]:
    """Those of some parts that decide a run."""
    return {part: names[part] for part in NEEDED if part in names}


def named(names: dict[str, str]) -> str:
    """Tell which parts of a run are not handeye's own."""
    return ", ".join(f"{part} {name}" for part, name in deciding(names).items()) or "handeye's own"


def name_of(code: Any) -> str:
    """The name of a function, a class, or of the class of anything else, with its module."""
    named = code if hasattr(code, "__qualname__") else type(code)
    return f"{named.__module__}.{named.__qualname__}"


OWN: Final = Parts()
"""All parts are handeye's own."""
