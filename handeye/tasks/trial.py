"""A trial: one task repeated in many worlds and counted, without running a program."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, Literal, TypeVar

from handeye.core.record import Record
from handeye.core.variation import WorldSpec

Known = Literal["lamp", "sightings", "drawn", "true"]
"""Camera calibration: made with the arm's lamp as in a run, by simulated sightings of a lamp, as drawn, or
exactly."""


class Attempt(Record, frozen=True, kw_only=True):
    """One attempt and its outcome."""

    seed: int  # seed of the world
    number: int  # index of the attempt in that world, from 0


A = TypeVar("A", bound=Attempt)


@dataclass(frozen=True, slots=True, kw_only=True)
class Count:
    """Counts over many attempts."""

    figures: Mapping[str, object]  # counts by their names, as JSON has them
    lines: tuple[str, ...]  # the same as lines of text
    wrong: int  # attempts in which something wrong was taken for right


class Trial(ABC, Generic[A]):
    """Something that can be tried without a program."""

    attempt: type[A]  # the class of its attempts

    def __repr__(self) -> str:
        return f"<{type(self).__name__}>"

    @abstractmethod
    def attempts(self, world: WorldSpec, number: int, *, camera: str, known: Known) -> Iterator[A]:
        """`number` attempts in a world, its camera calibrated once; pictures made by `auto`, `gl` or `ray`."""

    @abstractmethod
    def sentence(self, attempt: A) -> str:
        """The outcome of an attempt in a sentence."""

    @abstractmethod
    def count(self, attempts: Sequence[A]) -> Count:
        """Counts over attempts, of which there is at least one."""

    def outcome(self, attempt: A) -> Literal["right", "missed", "wrong"]:
        """The outcome of an attempt: by default right, unless something wrong was taken for right."""
        return "wrong" if self.count([attempt]).wrong else "right"
