"""Whole runs and statistics over them: where concrete cells, plans and referees are put together."""

from __future__ import annotations

from collections.abc import Iterable
from typing import TYPE_CHECKING

if TYPE_CHECKING:  # a trial is seldom wanted where something in this folder is
    from handeye.api.plans import FileName, Planned
    from handeye.api.worlds import World
    from handeye.results.judging import Limits, Referee
    from handeye.touch.spiral import SearchPattern
    from handeye.trials.results import Results

__all__ = ["assemble_each"]


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
    """Carry out a script in each of some worlds, and have each result judged.

    Args:
        worlds: seeds, or worlds.
        script: what `handeye.plan` takes; by default that of the water pump.
        taught: as for `handeye.plan`.
        camera: how pictures are made: `auto`, `gl` or `ray`.
        search: as for `handeye.begin`.
        referee: as for `handeye.begin`.
        jobs: processes at a time; with more than 1 a program must be guarded by `if __name__ == "__main__":`, and
            limits are taken, but no code in the place of a part.

    Returns:
        a table of results in the order of the worlds.

    Raises:
        ScriptError: the script has errors.
        InvalidInput: an argument cannot be used.

    >>> results = handeye.trials.assemble_each([0, 1], script="OPEN 1\\n", camera="ray")
    >>> [(result.seed, result.completed) for result in results]
    [(0, True), (1, True)]
    """
    from handeye.trials.results import assemble_in

    return assemble_in(
        worlds, script=script, taught=taught, camera=camera, search=search, referee=referee, jobs=jobs
    )
