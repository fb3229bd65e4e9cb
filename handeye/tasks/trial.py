"""A trial: one task repeated in many worlds and counted, without running a program."""

from abc import ABC, abstractmethod
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from typing import Generic, Literal, TypeVar

from handeye.core.record import Record
from handeye.core.variation import WorldSpec

Known = Literal["lamp", "sightings", "drawn", "true"]
"""Origin of the camera calibration in a trial: the arm's lamp, as in a run; simulated sightings of a lamp; the
design; or the true camera.
"""


class Attempt(Record, frozen=True, kw_only=True):
    """One attempt of a trial, with its outcome."""

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
    """A kind of attempt that can be repeated without a program."""

    attempt: type[A]  # the class of its attempts

    def __repr__(self) -> str:
        return f"<{type(self).__name__}>"

    @abstractmethod
    def attempts(self, world: WorldSpec, number: int, *, camera: str, known: Known) -> Iterator[A]:
        """`number` attempts in a world, with the camera calibrated once; pictures are rendered by `auto`, `gl` or
        `ray`.
        """

    @abstractmethod
    def sentence(self, attempt: A) -> str:
        """The outcome of an attempt as a sentence."""

    @abstractmethod
    def count(self, attempts: Sequence[A]) -> Count:
        """Count attempts, of which there must be at least one."""

    def outcome(self, attempt: A) -> Literal["right", "missed", "wrong"]:
        """The outcome of an attempt; by default right, unless the attempt took something wrong for right."""
        return "wrong" if self.count([attempt]).wrong else "right"
