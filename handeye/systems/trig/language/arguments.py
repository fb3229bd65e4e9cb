"""Parses the arguments of a command according to their kinds."""

import re
from collections.abc import Callable
from dataclasses import dataclass
from typing import Final, Literal

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.core.record import Vector3
from handeye.core.units import OUNCE_FORCE
from handeye.systems.trig.language.desk import number
from handeye.systems.trig.language.graph import GUARDED, NORMAL, TOP_NAME
from handeye.systems.trig.language.place import name_of

Kind = Literal["position", "signed", "step", "branch", "count", "threshold", "vector", "file"]
BRANCHES: Final = {"N": NORMAL, "NORMAL": NORMAL, "G": GUARDED, "GUARDED": GUARDED}
MAX_COUNT: Final = 999_999_999  # steps of a run, rounds of a loop
_VECTOR: Final = re.compile(r"\(\s*(\S+)[\s,]+(\S+)[\s,]+(\S+?)\s*\)")


@dataclass(slots=True, kw_only=True)
class Arguments:
    """The arguments of a command. An omitted argument is None. `negate` is True if the position has a minus sign;
    `threshold` is in N."""

    position: str | None = None
    negate: bool = False
    step: str | None = None
    branch: int | None = None
    count: int | None = None
    threshold: float | None = None
    vector: Vector3 | None = None
    file: str | None = None


def read_arguments(usage: str, takes: tuple[Kind, ...], needs: int, rest: str) -> Arguments:
    """Parse arguments of these kinds. `needs` is the number of required arguments, which come first. Raises
    BadArgument if the arguments are wrong. Its message shows `usage`.
    """
    given = Arguments()
    words = [rest] if takes and takes[0] in ("file", "vector") and rest else rest.split()
    if len(words) < needs:
        raise BadArgument(f"`{usage}` needs {_NOUNS[takes[len(words)]]}")
    if len(words) > len(takes):
        raise BadArgument(f"`{usage}` takes no further operand; remove {quoted(words[len(takes)])}")
    for kind, word in zip(takes, words, strict=False):
        if kind == "signed":
            given.negate, word = word.startswith("-"), word.removeprefix("-")
        field, read = _READERS[kind]
        setattr(given, field, read(word))
    return given


def read_branch(word: str) -> int:
    """Parse a branch of a guarded step. Raises BadArgument if the word is not a branch."""
    branch = BRANCHES.get(word.strip().rstrip(".").upper())
    if branch is None:
        raise BadArgument(f"{quoted(word.strip())} is not a branch; type n (normal) or g (guarded)")
    return branch


def read_threshold(word: str) -> float:
    """Parse a threshold given in ounces, and convert it to N. Raises BadArgument if the word is not a number, or is
    negative.
    """
    ounces = number(word.strip())
    if ounces < 0:
        raise BadArgument(f"a threshold must be 0 oz or more, not {quoted(word.strip())}")
    return ounces * OUNCE_FORCE


def read_vector(text: str) -> Vector3:
    """Parse a force vector, which is typed as three weights in parentheses. Raises BadArgument if the text has another
    form, or if all three weights are 0.
    """
    found = _VECTOR.fullmatch(text.strip())
    if found is None:
        raise BadArgument(f"{quoted(text.strip())} is not a force vector; write it like (0 0 1)")
    x, y, z = map(number, found.groups())
    if (x, y, z) == (0, 0, 0):
        raise BadArgument(
            "the force vector (0 0 0) has no direction; write (0 0 1), for example, to feel an upward force"
        )
    return x, y, z


def _position(word: str) -> str:
    if word.startswith("-"):
        raise BadArgument(f"a minus sign has no meaning here: type {quoted(word[1:])}")
    return name_of(word)


def _step(word: str) -> str:
    return TOP_NAME if word.upper() == TOP_NAME else name_of(word)


def _count(word: str) -> int:
    if not re.fullmatch(r"[+-]?\d+", word, re.ASCII):
        raise BadArgument(f"{quoted(word)} is not a whole number")
    if len(word) > 10 or abs(int(word)) > MAX_COUNT:
        raise BadArgument(f"{quoted(word)} is more than {MAX_COUNT}")
    return int(word)


_READERS: Final[dict[Kind, tuple[str, Callable[[str], object]]]] = {
    "position": ("position", _position),
    "signed": ("position", name_of),
    "step": ("step", _step),
    "branch": ("branch", read_branch),
    "count": ("count", _count),
    "threshold": ("threshold", read_threshold),
    "vector": ("vector", read_vector),
    "file": ("file", str),
}
_NOUNS: Final[dict[Kind, str]] = {
    "position": "the name of a position",
    "signed": "the name of a position",
    "step": "the name of a step",
    "branch": "a branch, n or g",
    "count": "a whole number",
    "threshold": "a threshold in ounces",
    "vector": "a force vector such as (0 0 1)",
    "file": "the name of a file",
}
