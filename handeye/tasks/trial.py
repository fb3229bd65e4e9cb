"""A trial: one thing tried in many worlds and counted, without carrying out a program."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, Literal, TypeVar

from handeye.core.record import Record
from handeye.core.variation import WorldSpec

Known = Literal["lamp", "sightings", "drawn", "true"]
"""What the program knows of its camera: what its own lamp shows it, as in a run; what so many simulated sightings of a
lamp would; its drawing; everything."""


class Attempt(Record, frozen=True, kw_only=True):
    """One attempt, with what came of it."""

    seed: int
    """Of its world."""
    number: int
    """Of the attempt in that world, from 0."""


A = TypeVar("A", bound=Attempt)


@dataclass(frozen=True, slots=True, kw_only=True)
class Count:
    """Counts over many attempts."""

    figures: Mapping[str, object]
    """For programs."""
    lines: tuple[str, ...]
    """For people."""
    wrong: int
    """How often something wrong was taken for right."""


class Trial(ABC, Generic[A]):
    """One thing to try."""

    attempt: type[A]
    """The class of its attempts."""

    @abstractmethod
    def attempts(self, world: WorldSpec, number: int, *, camera: str, known: Known) -> Iterator[A]:
        """So many attempts in a world, its camera calibrated once; pictures made by `auto`, `gl` or `ray`.

        Raises:
            InvalidInput: there is no such world, or pictures cannot be made so here.
        """

    @abstractmethod
    def sentence(self, attempt: A) -> str:
        """What came of an attempt, for people."""

    @abstractmethod
    def count(self, attempts: Sequence[A]) -> Count:
        """All attempts counted; there is at least one."""

    def outcome(self, attempt: A) -> Literal["right", "missed", "wrong"]:
        """How an attempt counts: by default as right, unless something wrong was taken for right."""
        return "wrong" if self.count([attempt]).wrong else "right"
