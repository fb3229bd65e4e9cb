"""Runs the worlds that subset simulation asks for, keeps their rows, and estimates the probability of each failure."""

from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, cast

import numpy as np
from msgspec.structs import replace

from handeye.core.diagnostics import quoted
from handeye.core.distributions import random_numbers
from handeye.core.errors import BadFile, Refused
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.core.world_file import WorldFile, write_world
from handeye.trials.folder import BatchFolder
from handeye.trials.rare.points import Point, WorldSpace
from handeye.trials.rare.row import (
    RARE,
    FailureKind,
    RareCase,
    RareRow,
    RareTrial,
    Usual,
    usual,
    world_digest,
)
from handeye.trials.rare.subset import Estimate, Level, estimate, subset_simulation
from handeye.trials.sweep import Engine, Work, carry_out

FIRST: Final = "level 0"  # condition of the runs in independent worlds, which all kinds of failures share
WORLDS: Final = "worlds"  # folder of the worlds in which the program fails


class LimitingPart(Record, frozen=True, kw_only=True):
    """The part that most often determined the margins at a level."""

    part: str
    share: float  # of the runs of the level


class Estimated(Record, frozen=True, kw_only=True):
    """The results of subset simulation for one kind of failure."""

    failure: FailureKind
    reached: bool
    """True if worlds with this kind of failure were found. If False, the estimate is the probability that a run's
    margin is at most the threshold of the last level.
    """
    threshold: float
    estimate: Estimate
    levels: tuple[Level, ...]
    limiting: tuple[LimitingPart, ...]  # one for each level
    runs: int  # those of level 0 included


@dataclass(frozen=True, slots=True, kw_only=True)
class Failing:
    """A world in which the program failed."""

    row: RareRow
    point: Point
    kind: FailureKind


@dataclass(slots=True, kw_only=True)
class Campaign:
    """Runs the program in worlds, and remembers the results. Runs whose rows are already in the folder are not
    repeated.
    """

    trial: RareTrial
    space: WorldSpace
    runs: int  # of each level
    engine: Engine
    folder: BatchFolder[RareRow] | None = None
    told: Callable[[RareRow], None] = lambda _: None
    rows: list[RareRow] = field(default_factory=list)
    failing: list[Failing] = field(default_factory=list)
    _first: tuple[RareRow, ...] = ()
    _points: tuple[Point, ...] = ()

    def first(self) -> tuple[RareRow, ...]:
        """Run the worlds of level 0. Their seeds are consecutive numbers that begin with the trial's seed."""
        if not self._first:
            seeds = range(self.trial.world.seed, self.trial.world.seed + self.runs)
            self._points = tuple(map(self.space.seeded, seeds))
            self._first = self.run([(FIRST, number) for number in range(self.runs)], self._points)
        return self._first

    def estimated(self, kind: FailureKind, most: int, told: Callable[[Level], None]) -> Estimated:
        """Estimate the probability of a kind of failure. `most` is the greatest number of levels; `told` is called for
        each level.
        """
        known = usual(self.first())
        measured = _Measured(self, kind, known)
        levels = []
        for level in subset_simulation(self._points, measured, self._stream(kind), most):
            levels.append(level)
            told(level)
        return Estimated(
            failure=kind,
            reached=levels[-1].failed > 0 and levels[-1].reached,
            threshold=levels[-1].threshold,
            estimate=estimate(levels),
            levels=tuple(levels),
            limiting=tuple(measured.limiting),
            runs=sum(level.runs for level in levels),
        )

    def run(
        self, places: Sequence[tuple[str, int]], points: Sequence[Point], *, kept: bool = True
    ) -> tuple[RareRow, ...]:
        """Run the worlds of the given points. `places` gives the condition of each point, and its number within this
        condition. If `kept` is True, the worlds in which the program fails are written to files. Raises InvalidInput
        if a run ended because this computer failed; the margin of such a run is unknown.
        """
        cases = [
            RareCase(
                trials=(number,), seed=point.noise, condition=condition, world=self.world(condition, point)
            )
            for (condition, number), point in zip(places, points, strict=True)
        ]
        work = cast("Work[RareRow]", self.trial)  # `Trial` makes rows of the class that `row` names
        rows = carry_out(RARE, work, cases, self.engine, folder=self.folder, told=self.told)
        for case, row, point in zip(cases, rows, points, strict=True):
            _check(row, case)
            self.rows.append(row)
            if row.failure is not None and kept:
                self.failing.append(Failing(row=row, point=point, kind=row.failure))
                self.write(file_of(row), row, case.world)
        return rows

    def world(self, condition: str, point: Point) -> WorldSpec:
        """Return the world of a point. At level 0, this is the world of seed `point.noise`: the same world that every
        other command makes from this seed.
        """
        if condition == FIRST:
            return replace(self.trial.world, seed=point.noise)
        return self.space.world(point)

    def write(self, name: str, row: RareRow, world: WorldSpec) -> None:
        """If the batch has a folder, write a failing world into it."""
        if self.folder is None:
            return
        place = self.folder.path / WORLDS
        place.mkdir(exist_ok=True)
        about = f"{row.failure or 'right'}: {row.detail}"
        write_world(place / name, WorldFile(task=self.trial.plan.task, about=about, world=world))

    def _stream(self, kind: FailureKind) -> Callable[[int], np.random.Generator]:
        return lambda level: random_numbers(self.trial.world.seed, f"rare.{kind}.{level}")


def file_of(row: RareRow) -> str:
    """Return the name of the file with the world of a run."""
    return f"{row.condition.replace(',', '').replace(' ', '-')}-{row.trial}.json"


def forget_worlds(folder: Path) -> None:
    """Delete the worlds that an earlier search wrote into the folder of a batch."""
    for file in (folder / WORLDS).glob("*.json"):
        file.unlink()


def _check(row: RareRow, case: RareCase) -> None:
    """Raise InvalidInput if a row is of another world, or if its run must be repeated."""
    if row.seed != case.seed or row.world not in ("", world_digest(case.world)):
        raise BadFile(
            f"run {row.trial} of {quoted(row.condition)} was tried in one world, and this command would try it in "
            "another"
        )
    if row.to_be_tried_again:
        raise Refused(
            f"run {row.trial} of {quoted(row.condition)} ended because this computer failed ({row.detail}); the same "
            "command tries it again"
        )


class _Measured:
    """Runs the program in the world of each point of a level, and measures how far each run was from one kind of
    failure.
    """

    def __init__(self, campaign: Campaign, kind: FailureKind, known: Usual) -> None:
        self._campaign, self._kind, self._usual = campaign, kind, known
        self._parts: dict[int, Counter[str]] = {}

    def __call__(self, level: int, points: Sequence[Point]) -> list[float]:
        parts = self._parts.setdefault(level, Counter())
        done, condition = parts.total(), f"{self._kind}, level {level}"
        places = [(condition, done + number) for number in range(len(points))]
        rows = self._campaign.run(places, points) if level else self._campaign.first()
        found = [self._usual.margin(row, self._kind) for row in rows]
        parts.update(margin.part for margin in found)
        return [margin.value for margin in found]

    @property
    def limiting(self) -> Iterator[LimitingPart]:
        """For each level, the part of the pump that most often determined the margins."""
        for parts in self._parts.values():
            part, count = parts.most_common(1)[0]
            yield LimitingPart(part=part, share=count / parts.total())
