"""Checks the parts of a run that a caller can replace (search pattern, camera, referee) and wraps them, so that
their results are checked too.
"""

from collections.abc import Callable, Mapping
from functools import cache
from typing import Any, Final, TypeVar

import numpy as np

from handeye.cell.rendering import CameraMaker, ReplacedCamera
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadArgument, NoSuchName
from handeye.results.judging import Limits, Referee, checked_findings, checked_limits
from handeye.runs.parts import Parts, VisionFunction, name_of
from handeye.touch.spiral import SearchPattern
from handeye.vision.replaceable import WRAPPERS

CAMERAS: Final = ("auto", "gl", "ray")


Camera = str | CameraMaker
"""`auto`, `gl` (OpenGL), `ray` (ray casting), or a function or class that makes a renderer for a scene."""

Vision = Mapping[str, VisionFunction]
"""Functions behind the instructions `GENERAL`, `SPECIFIC` and `INSPECT`; see `handeye.begin`."""

Code = TypeVar("Code", bound=Callable[..., Any])


def parts_of(search: SearchPattern | None, camera: Camera, vision: Vision | None = None) -> Parts:
    """Collect the caller's search pattern, camera and vision functions. Raises InvalidInput if one of them cannot be
    called, or if the camera or an instruction has an unknown name.
    """
    if isinstance(camera, str):
        if camera not in CAMERAS:
            near = suggestion(camera, CAMERAS)
            raise NoSuchName(f"there is no camera {quoted(camera)}; {near}")
        maker = None
    else:
        if not callable(camera):
            raise BadArgument(
                f"a camera must be `auto`, `gl`, `ray` or a function that takes a scene; {camera!r} is none of "
                "these"
            )
        name = name_of(camera)
        maker = _named(lambda model: ReplacedCamera(name, camera, model), camera)
    pattern = None if search is None else _checked_search(search)
    return Parts(search=pattern, camera=maker, vision=_checked_vision(vision or {}))


def limits_of(given: Referee | Limits | None) -> dict[str, float] | None:
    """Return the limits if the caller gave limits, or None if the caller gave a referee or nothing. Raises
    InvalidInput if a limit is not a number.
    """
    return checked_limits(given) if isinstance(given, Mapping) else None


def referee_of(given: Referee | Limits | None) -> Referee | None:
    """Return the caller's referee, wrapped so that its results are checked, or None if the referee of the task judges.
    Raises InvalidInput if the argument is neither a function nor a table of limits.
    """
    if given is None or isinstance(given, Mapping):
        return None
    if not callable(given):
        raise BadArgument(
            "a referee must be either a table of limits or a function that takes the true state of a cell, not "
            f"{given!r}"
        )
    name = name_of(given)
    return _named(lambda truth: checked_findings(name, given(truth)), given)


def _checked_vision(vision: object) -> dict[str, VisionFunction]:
    """Wrap the caller's vision functions. Raises InvalidInput if the functions cannot be used."""
    if not isinstance(vision, Mapping):
        raise BadArgument(f"`vision` must be a dictionary from instructions to functions, not {vision!r}")
    for word, function in vision.items():
        if word not in WRAPPERS:
            raise NoSuchName(
                f"vision has no function for {word!r}; you can give one for {', '.join(WRAPPERS)}"
            )
        if not callable(function):
            raise BadArgument(f"the vision of {word} must be a function; {function!r} is not a function")
    return {
        word: _named(WRAPPERS[word](name_of(function), function), function)
        for word, function in vision.items()
    }


def _checked_search(search: SearchPattern) -> SearchPattern:
    if not callable(search):
        raise BadArgument(
            "a search must be a function that takes a whole number and returns the place with this number; "
            f"{search!r} is not a function"
        )

    name = name_of(search)

    @cache  # because AOJ, each MOVE and every display ask for a place
    def place(number: int) -> tuple[float, float] | None:
        try:
            given = search(number)
        except StopIteration:
            given = None
        return None if given is None and number > 0 else _checked_place(name, number, given)

    return _named(place, search)


def _checked_place(name: str, number: int, given: object) -> tuple[float, float]:
    """Return the place that a search pattern returned, as two numbers. Raises InvalidInput if the place is not a pair
    of finite numbers.
    """
    try:
        x, y = (float(each) for each in np.asarray(given, dtype=object))
    except (TypeError, ValueError):
        x = y = np.nan
    if not np.isfinite([x, y]).all():
        raise BadArgument(f"the search `{name}` must return two numbers for place {number}, not {given!r}")
    return x, y


def _named(wrapped: Code, code: Any) -> Code:
    """Give the wrapper of a caller's function the name of that function."""
    wrapped.__module__, _, wrapped.__qualname__ = name_of(code).partition(".")
    return wrapped
