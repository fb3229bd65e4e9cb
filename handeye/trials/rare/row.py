"""One run in a sample of worlds, and the margin of the run: how far it was from failing."""

import hashlib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from math import inf
from statistics import median
from typing import ClassVar, Final, Literal, get_args

import msgspec

from handeye.core.host_time import HostTimer
from handeye.core.variation import WorldSpec
from handeye.results.result import Check
from handeye.runs.host_seconds import Meter
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.trials.assembly import run_plan
from handeye.trials.plans.row import OUTCOMES, Row
from handeye.trials.plans.trial import Trial, Watch, facts
from handeye.trials.rare.reserves import Reserves
from handeye.trials.sweep import Case, Sweep

FailureKind = Literal["stopped", "silent"]
KINDS: Final[tuple[FailureKind, ...]] = get_args(FailureKind)
_ALMOST: Final = 1e-6  # least margin of a run that did not fail
_USUAL: Final = 1.0  # margin of a run in which nothing limits the program


class RareCase(Case, frozen=True, kw_only=True):
    """A run in a world that no other run has."""

    world: WorldSpec


class RareRow(Row, frozen=True, kw_only=True):
    """A run, with the reserves that the program had left."""

    left: Mapping[str, float] = {}
    """For each search, each loop with a counter, and each check: the least reserve that the program had in the run;
    see `Reserves`.
    """
    world: str = ""  # digest of the world; empty if the run was lost

    @property
    def failure(self) -> FailureKind | None:
        """The kind of failure; None if the program did not fail. A run that was broken off counts as stopped."""
        return {"silent": "silent", "assembled": None}.get(self.verdict, "stopped")


@dataclass(frozen=True, slots=True, kw_only=True)
class Margin:
    """The margin of a run. `part` names what determines the margin: a reserve of the program, a finding of the
    referee, or the cause at which the program stopped. `part` is empty if nothing determines the margin.
    """

    value: float
    """A value of 1 means that the run had the reserve that runs usually have. A value of 0 or less means that the run
    had the kind of failure for which the margin was computed. An infinite value means that the run gives no
    information about this kind of failure.
    """
    part: str


@dataclass(frozen=True, slots=True, kw_only=True)
class Usual:
    """The usual reserves: for each part of a margin, the median over the runs of the first level. Divided by
    its median, each part is a number without a unit, so that parts can be compared.
    """

    program: Mapping[str, float]
    referee: Mapping[str, float]

    def margin(self, row: RareRow, kind: FailureKind) -> Margin:
        """Return the margin of a run from one kind of failure."""
        return self._from_stop(row) if kind == "stopped" else self._from_silence(row)

    def _from_stop(self, row: RareRow) -> Margin:
        if row.failure == "stopped":
            return Margin(value=0.0, part=row.cause)
        least = _least(row.left, self.program)
        return Margin(value=max(least.value, _ALMOST), part=least.part)

    def _from_silence(self, row: RareRow) -> Margin:
        if row.failure == "stopped" or row.result is None:
            return Margin(value=inf, part="")
        checks = row.result.referee
        if row.failure is None:
            least = _least(limits_left(checks), self.referee)
            return Margin(value=max(least.value, _ALMOST), part=least.part)
        wrong = {name: -check_left(check) for name, check in checks.items() if check.refuses}
        worst = max(wrong, key=lambda name: wrong[name] / self.referee.get(name, 1.0), default="")
        return Margin(value=-wrong.get(worst, 0.0) / self.referee.get(worst, 1.0), part=worst)


def usual(rows: Sequence[RareRow]) -> Usual:
    """Return the reserves that the runs of a first level usually have left. A reserve is omitted if at least half of
    the runs have nothing left of it. Such a reserve does not show how close a run was to failing.
    """
    judged = [limits_left(row.result.referee) for row in rows if row.result is not None]
    return Usual(program=_medians([row.left for row in rows]), referee=_medians(judged))


def limits_left(checks: Mapping[str, Check]) -> dict[str, float]:
    """Return the distance of each finding from its limit, in the unit of the finding. A finding exactly at its limit
    is left out: only counts reach their limits exactly, and a count at its limit is right.
    """
    found = {name: check_left(check) for name, check in checks.items() if not check.caution}
    return {name: left for name, left in found.items() if left or not checks[name].ok}


def check_left(check: Check) -> float:
    """Return the distance of a finding from its limit, in the unit of the finding. The distance is positive within the
    limit and negative beyond it.
    """
    left = check.limit - check.value
    return left if check.relation == "at most" else -left


def _medians(each: Sequence[Mapping[str, float]]) -> dict[str, float]:
    names = dict.fromkeys(name for left in each for name in left)
    found = {name: median(left[name] for left in each if name in left) for name in names}
    return {name: value for name, value in found.items() if value > 0}


def _least(left: Mapping[str, float], known: Mapping[str, float]) -> Margin:
    shares = {name: left[name] / known[name] for name in left if name in known}
    part = min(shares, key=lambda name: shares[name], default="")
    return Margin(value=shares.get(part, _USUAL), part=part)


@dataclass(frozen=True, slots=True, kw_only=True)
class RareTrial(Trial):
    """Runs a plan in the world of a case, and records the reserves of the program: how far the program was from each
    failure.
    """

    row: ClassVar[type[Row]] = RareRow

    def _world(self, case: Case) -> WorldSpec:
        return case.world if isinstance(case, RareCase) else Trial._world(self, case)

    def _facts(self, world: WorldSpec, timer: HostTimer, watch: Watch) -> dict[str, object]:
        noted: list[Reserves] = []

        def observers(runner: Runner) -> tuple[Observer, ...]:
            noted.append(Reserves(runner))
            return (*watch.looking_on(runner), noted[-1])

        done = run_plan(
            self.plan, world=world, camera=self.camera, meter=Meter(timer=timer), observers=observers,
            halt=watch.over, without=self.without,
        )  # fmt: skip
        return facts(done, watch.ended) | {"left": noted[-1].left, "world": world_digest(world)}


def world_digest(world: WorldSpec) -> str:
    """Return sixteen hexadecimal digits that identify a world."""
    return hashlib.sha256(msgspec.json.encode(world)).hexdigest()[:16]


RARE: Final = Sweep(
    kind="rare", row=RareRow, outcomes=OUTCOMES, success="assembled", noun="run", shared_worlds=True
)
"""Runs in worlds that a search for rare failures chooses. Their rate of success means nothing."""
