"""Listings and plans of programs that are texts of numbered lines."""

from bisect import bisect_right
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from typing import ClassVar, TypeVar

import msgspec

from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.program.operation import Device

P = TypeVar("P", bound=Record)


@dataclass(frozen=True, slots=True, kw_only=True)
class NumberedStep:
    """A line of a listing. `line` is its own number."""

    line: int
    text: str
    word: str
    ways: tuple[int | None, ...]
    guarded: bool = False
    needs: Device | None = None
    stage: ClassVar[int] = 0
    file: ClassVar[str] = ""
    macro: ClassVar[str] = ""
    examines: ClassVar[None] = None
    begins_search: ClassVar[bool] = False

    @property
    def place(self) -> str:
        return str(self.line)


@dataclass(frozen=True, slots=True, kw_only=True)
class NumberedListing:
    """The executable lines of a program, in the order of their numbers. The program is one stage."""

    name: str
    source: str
    steps: Sequence[NumberedStep]
    numbered: Mapping[int, str]
    labels: Mapping[str, Sequence[int]] = field(default_factory=dict)
    required: ClassVar[dict[str, str]] = {}
    errors: ClassVar[tuple[int, ...]] = ()

    @property
    def stages(self) -> tuple[str, ...]:
        return (self.name,)

    def step_of(self, number: int) -> int:
        """Return the step of the line `number`. If the listing does not contain this line, return the last step before
        it.
        """
        return max(bisect_right(self.steps, number, key=lambda step: step.line) - 1, 0)


def encode(plan: Record) -> bytes:
    return msgspec.json.format(msgspec.json.encode(plan), indent=1) + b"\n"


def decode(data: bytes, name: str, kind: type[P], check: Callable[[P], None]) -> P:
    """Decode a plan and check it. Raises BadFile if the data are not a valid plan."""
    try:
        plan = msgspec.json.decode(data, type=kind)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{name} is not a valid plan: {error}") from None
    check(plan)
    return plan
