"""The results of many runs as a table."""

from collections.abc import Iterable, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Final, overload

import numpy as np

from handeye.api.parts import limits_of, parts_of, referee_of
from handeye.api.plans import FileName, Planned, plan
from handeye.api.worlds import World
from handeye.core.arguments import given_count
from handeye.core.brief import Several
from handeye.core.errors import BadArgument
from handeye.core.notebook import heading, inked, page, table
from handeye.core.variation import WorldSpec, checked_seed
from handeye.planfile.plan import Plan
from handeye.results.judging import Limits, Referee
from handeye.results.result import Check, Result
from handeye.runs.scripts import default_script
from handeye.touch.spiral import SearchPattern
from handeye.trace.table import SHOWN_ROWS, Column, Table
from handeye.trials.assembly import run_plan
from handeye.trials.workers import in_processes

_VERDICTS: Final = {0: ("assembled", "good"), 1: ("stopped", "doubtful"), 3: ("not right", "bad")}
"""Verdict and colour by exit code."""
_TOLD: Final = 2  # Greatest number of findings in a row


@dataclass(frozen=True, slots=True, repr=False)
class Results(Sequence[Result]):
    """Results in the order of their worlds. `print` and notebooks display the results as a table."""

    each: tuple[Result, ...]

    @property
    def assembled(self) -> int:
        """Number of worlds in which the referee accepted the work."""
        return sum(result.assembled is True for result in self.each)

    @overload
    def __getitem__(self, index: int) -> Result: ...
    @overload
    def __getitem__(self, index: slice) -> "Results": ...
    def __getitem__(self, index: int | slice) -> "Result | Results":
        return Results(self.each[index]) if isinstance(index, slice) else self.each[index]

    def __len__(self) -> int:
        return len(self.each)

    def __repr__(self) -> str:
        rows = [("world", "verdict", "working phase", "")]
        for each in self.each[:SHOWN_ROWS]:
            rows.append((str(each.world), _verdict(each)[0], f"{each.timing.working_s:.1f} s", why(each)))
        widths = [max(len(row[n]) for row in rows) for n in range(3)]
        lines = ["  ".join([*map(str.ljust, row, widths), row[3]]).rstrip() for row in rows]
        more = [f"… and {len(self) - SHOWN_ROWS} more"] if len(self) > SHOWN_ROWS else []
        return "\n".join([*lines, *more, self._count()])

    def _repr_html_(self) -> str:
        rows = [
            (str(each.world), inked(*_verdict(each)), each.timing.working_s, why(each)) for each in self.each
        ]
        return page(table(("world", "verdict", "working phase, s", ""), rows), heading(self._count()))

    def table(self) -> Table:
        """Return the results as a table with one row per world: verdict, times, and the value of each finding
        of the referee."""
        findings = {name: each for result in self.each for name, each in result.referee.items()}
        columns = (
            Column(
                name="seed", about="seed of the world", values=np.array([each.seed for each in self.each])
            ),
            _words("world", "how the world was generated", (str(each.world) for each in self.each)),
            _words("verdict", "assembled, stopped or not right", (_verdict(each)[0] for each in self.each)),
            _words("why", "why the result is not right", map(why, self.each)),
            _seconds("working", (each.timing.working_s for each in self.each)),
            _seconds("lens", (each.timing.lens_s for each in self.each)),
            *(_found(name, check, self.each) for name, check in findings.items()),
        )
        return Table(name="results", about=self._count(), columns=columns)

    def _count(self) -> str:
        return f"{self.assembled} of {len(self)} assembled"


def assemble_each(
    worlds: Iterable[int | World],
    *,
    script: FileName | Planned | None = None,
    taught: FileName | None = None,
    camera: str = "auto",
    search: SearchPattern | None = None,
    referee: Referee | Limits | None = None,
    jobs: int = 1,
) -> Results:
    """Run a script in several worlds, and let the referee judge each result.

    Args:
        worlds: seeds or worlds.
        script: a script or plan, as for `handeye.plan`; by default the script of the water pump.
        taught: taught positions, as for `handeye.plan`.
        camera: renderer of the TV camera: `auto`, `gl` or `ray`.
        search: search pattern, as for `handeye.begin`.
        referee: referee or limits, as for `handeye.begin`.
        jobs: number of parallel processes. If there is more than one process, guard the calling program with `if
            __name__ == "__main__":`. In this case, `search` cannot be Python code, and `referee` can only be a set of
            limits.

    Returns:
        a table of results in the order of the worlds.

    Raises:
        ScriptError: the script has errors.
        InvalidInput: an argument cannot be used.

    >>> results = handeye.trials.assemble_each([0, 1], script="OPEN 1\\n", camera="ray")
    >>> [(result.seed, result.completed) for result in results]
    [(0, True), (1, True)]
    """
    if isinstance(worlds, str) or not isinstance(worlds, Iterable):
        raise BadArgument(f"worlds must be a sequence of seeds or worlds, not {worlds!r}")
    specs = [_spec(world) for world in worlds]
    record = plan(default_script() if script is None else script, taught=taught).record
    parts, own_referee, limits = parts_of(search, camera), referee_of(referee), limits_of(referee)
    if given_count(jobs, "jobs") == 1:
        trial = partial(run_plan, record, camera=camera, limits=limits, parts=parts, own_referee=own_referee)
        return Results(Several(trial(world=spec).result for spec in specs))
    if search is not None or own_referee is not None:
        raise BadArgument("code that replaces a part of the run needs one process: leave out `jobs=...`")
    found = list(in_processes(partial(_result, record, camera, limits), specs, jobs))
    return Results(Several(sorted(found, key=lambda result: specs.index(result.world))))


def _result(record: Plan, camera: str, limits: Limits | None, world: WorldSpec) -> Result:
    return run_plan(record, world=world, camera=camera, limits=limits).result


def why(result: Result) -> str:
    """Return the reason why a result is not right. If several findings failed, the reason is the first of these
    findings. The text is empty if the result is right.
    """
    if not result.completed:
        return f"{result.stopped_at or ''}: {result.message}"
    wrong = [each.told for each in result.referee.values() if each.refuses]
    more = len(wrong) - _TOLD
    return "; ".join(wrong if more < 2 else [*wrong[:_TOLD], f"and {more} more"])


def _words(name: str, about: str, values: Iterable[str]) -> Column:
    return Column(name=name, about=about, values=tuple(values))


def _seconds(name: str, values: Iterable[float]) -> Column:
    return Column(name=f"{name}_s", about=f"the timing table's {name}", unit="s", values=np.array([*values]))


def _found(name: str, check: Check, results: Iterable[Result]) -> Column:
    values = [each.referee[name].value if name in each.referee else np.nan for each in results]
    return Column(name=name, about=check.subject, unit=check.unit, values=np.array(values, dtype=float))


def _verdict(result: Result) -> tuple[str, str]:
    return _VERDICTS[result.exit_code]


def _spec(world: int | World) -> WorldSpec:
    if isinstance(world, World):
        return world.spec
    if isinstance(world, (str, bytes)):
        raise BadArgument(f"a world must be a seed or a handeye.World, not {world!r}")
    return WorldSpec(seed=checked_seed(world))
