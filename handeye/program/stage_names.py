"""Finds stages by number, by name or by a part of the name."""

import re
from collections.abc import Sequence
from typing import Final

from handeye.core.diagnostics import nearest, quoted
from handeye.core.errors import BadArgument, NoSuchName

_NUMBER: Final = re.compile(r"[0-9]{1,9}")


def stage_index(text: str, stages: Sequence[str]) -> int:
    """Return the index of a stage. `text` is the number of the stage (from 1), its name, or a unique part of its
    name. Raises NoSuchName if there is no such stage.
    """
    if _NUMBER.fullmatch(text.strip()):
        if not 1 <= int(text) <= len(stages):
            raise NoSuchName(f"there is no stage {int(text)}; the program has stages 1 to {len(stages)}")
        return int(text) - 1
    found = stage_called(text, stages)
    if found is None:
        raise NoSuchName(f"there is no stage {quoted(text.strip())}{_meant(text, stages)}")
    return found


def stage_called(text: str, stages: Sequence[str]) -> int | None:
    """Find the stage that `text` means. A stage with exactly this name has precedence. Next comes a stage whose name
    begins with the text, and then a stage whose name contains it. Returns the index of the stage, or None if no stage
    matches. Raises BadArgument if several stages match equally well.
    """
    wanted = text.strip().casefold()
    names = [name.casefold() for name in stages]
    if not wanted:
        return None
    for fits, how in ((str.__eq__, "are"), (str.startswith, "begin with"), (str.__contains__, "contain")):
        found = [number for number, name in enumerate(names) if fits(name, wanted)]
        if len(found) > 1:
            several = ", ".join(f"{number + 1} {quoted(stages[number])}" for number in found)
            raise BadArgument(f"{len(found)} stages {how} {quoted(text.strip())}: {several}")
        if found:
            return found[0]
    return None


def _meant(text: str, stages: Sequence[str]) -> str:
    """Write the end of an error sentence: `; did you mean ...` with the similar names of stages. If no name is
    similar, write the names of all stages.
    """
    typed = text.strip().casefold()
    words = {word for name in stages for word in (name, *name.split())}
    near = nearest(typed, words, len(typed) // 3)
    if near is None:
        known = ", ".join(f"{number} {quoted(name)}" for number, name in enumerate(stages, 1))
        return f"; the program has {known}"
    return f"; did you mean {' or '.join(quoted(name) for name in stages if near in name.casefold())}?"
