"""Defines a trial, which repeats one part of a task in many worlds without running a program, and counts the
outcomes."""

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
    """One attempt of a trial. Each kind of trial adds fields for the outcome."""

    seed: int  # seed of the world
    number: int  # index of the attempt in that world, from 0


A = TypeVar("A", bound=Attempt)


@dataclass(frozen=True, slots=True, kw_only=True)
class Count:
    """Counts of the outcomes of many attempts."""

    figures: Mapping[str, object]  # counts by name, for JSON
    lines: tuple[str, ...]  # the same as lines of text
    wrong: int  # attempts in which a wrong result was accepted


class Trial(ABC, Generic[A]):
    """A kind of attempt that can be repeated in many worlds without running a program."""

    attempt: type[A]  # the class of its attempts

    def __repr__(self) -> str:
        return f"<{type(self).__name__}>"

    @abstractmethod
    def attempts(self, world: WorldSpec, number: int, *, camera: str, known: Known) -> Iterator[A]:
        """Make `number` attempts in a world, after calibrating the camera once. `camera` is the renderer of the
        pictures: `auto`, `gl` or `ray`.
        """

    @abstractmethod
    def sentence(self, attempt: A) -> str:
        """Describe the outcome of an attempt in a sentence."""

    @abstractmethod
    def count(self, attempts: Sequence[A]) -> Count:
        """Count the outcomes of one or more attempts."""

    def outcome(self, attempt: A) -> Literal["right", "missed", "wrong"]:
        """Return the outcome of an attempt. By default, the outcome is `wrong` if the attempt accepted a wrong result,
        and `right` if not.
        """
        return "wrong" if self.count([attempt]).wrong else "right"
