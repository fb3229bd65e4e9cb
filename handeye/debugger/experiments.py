"""Experiments: giving what a system remembers another value, in the units of people."""

import math
import re
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, NoSuchName, Refused
from handeye.debugger.breakpoints import meant
from handeye.runs.runner import Runner
from handeye.runs.system import Settable

MAX_NUMBER: Final = 1000.0


def experiment(runner: Runner, text: str) -> None:
    """Set something: its kind, its name and numbers, as in `saved H 0 0 .1`. Raises InvalidInput if the system has no
    such thing, or these are not the numbers for it."""
    kind, _, rest = text.strip().partition(" ")
    settables = runner.system.settables()
    settable = settables.get(kind.casefold())
    if settable is None:
        known = " or ".join(f"`set {name} {each.usage}`" for name, each in settables.items())
        raise BadArgument(f"an experiment is {known}" if known else "nothing can be set in this run")
    if runner.trouble is not None:
        raise Refused("no experiment is possible here; go back first")
    name, numbers = _read(rest, settable, kind.casefold())
    values = tuple(number * unit for number, unit in zip(numbers, settable.units, strict=False))
    runner.experiment(kind.casefold(), name, values + settable.present(name)[len(values) :])


def _read(text: str, settable: Settable, kind: str) -> tuple[str, list[float]]:
    """The name and the numbers, brackets and commas left out."""
    name, *words = re.sub(r"[\[\](),]", " ", text).split() or [""]
    if not name or len(words) not in (settable.fewest, len(settable.units)):
        raise BadArgument(f"write an experiment as `set {kind} {settable.usage}`")
    numbers = [_number(word) for word in words]
    return _known(name, settable), numbers


def _number(word: str) -> float:
    try:
        value = float(word)
    except ValueError:
        value = math.nan
    if not abs(value) <= MAX_NUMBER:
        raise BadArgument(f"{quoted(word)} is not a number from {-MAX_NUMBER:g} to {MAX_NUMBER:g}")
    return value


def _known(name: str, settable: Settable) -> str:
    """The name as the program has it."""
    for choice in (name, name.upper()):
        if choice in settable.names:
            return choice
    raise NoSuchName(f"the program has no {settable.noun} {quoted(name)}{meant(name, settable.names)}")
