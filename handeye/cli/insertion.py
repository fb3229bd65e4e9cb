"""The command that tries insertions."""

import os
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final, Literal

from cyclopts import Parameter

from handeye.cli.common import Json, WholeNumber, positive, put_json, screen
from handeye.cli.tally import Tally
from handeye.core.errors import BadArgument
from handeye.core.files import Kind, check_place, write_over
from handeye.core.variation import checked_seed

if TYPE_CHECKING:
    from handeye.trials.insertion import Condition, InsertionTrial
    from handeye.trials.insertion_figures import Bench

GRID_N: Final = 10
"""Trials of each condition of the grid."""
PROGRAMS: Final = {"gentle": "the bench's own program", "1973": "the search of the listing of 1973"}
MOST_SD: Final = 5.0
"""mm: beyond it most holes would be beyond the search."""


def insertion(
    *,
    n: Annotated[WholeNumber, Parameter(name="--n", help="Trials of each condition.")] = GRID_N,
    seed: Annotated[WholeNumber, Parameter(help="The first world; ten trials are made in each.")] = 0,
    clearance: Annotated[
        float | None, Parameter(help="Of the hole in diameter, mm: .05 to 1; .114 if others are given.")
    ] = None,
    chamfer: Annotated[
        float | None, Parameter(help="Of the hole, mm: 0 (a sharp edge) to 2; 1 if others are given.")
    ] = None,
    sd: Annotated[
        float | None,
        Parameter(
            help="Sigma of the error of the hole's place along each axis, mm: 0 to 5; 1 if others are given."
        ),
    ] = None,
    search: Annotated[
        Literal["gentle", "1973"],
        Parameter(help="The bench's own program, or the search of the listing of 1973."),
    ] = "gentle",
    workers: Annotated[
        WholeNumber | None, Parameter(help="Processes at a time; by default one a processor, at most 4.")
    ] = None,
    json: Json = False,
    out: Annotated[
        Path | None, Parameter(help="File for a page with drawings (.html), or for all trials (.csv).")
    ] = None,
) -> int:
    """Put one pin into one hole, many times: success, peak force, and time from the first contact to seated.

    The product's own arm, hand, servo and program, against a plate with one hole, which is off by a normal error along
    either axis. Worlds differ in the errors of the arm and the hand, as those of the pump do. A trial begins where the
    program has fetched the pin and holds it over the hole. Without --clearance, --chamfer and --sd, a grid around the
    setting of a published bench is tried, which takes some minutes.

    Peak force is the greatest between pin and plate in any physics step, by the simulator's truth; the program never
    knows it.

    Ctrl-C ends it, and what has ended is told.

    Exit code 0: no silent failure; 3: in some trial the program said done, and the pin was not in its hole.
    """
    from handeye.trials.insertion import trials
    from handeye.trials.insertion_figures import Bench

    jobs = min(4, os.cpu_count() or 1) if workers is None else workers
    for count, what in ((n, "trial"), (jobs, "process")):
        positive(count, what)
    if out is not None:
        check_place(out, _kind(out))
    conditions = _conditions(clearance, chamfer, sd, search)
    found: list[InsertionTrial] = []
    try:
        ended = trials(conditions, n, seed=checked_seed(seed), workers=jobs)
        for trial in Tally(n * len(conditions), "insertions").counting(ended):
            found.append(trial)
    finally:  # what has ended when it is broken off, too
        if found:
            tried = Bench.of(conditions, found)
            _tell(tried, f"Worlds from {seed} on; {PROGRAMS[search]}.", json=json, out=out)
    return 3 if any(trial.outcome == "silent" for trial in found) else 0


def _tell(bench: "Bench", title: str, *, json: bool, out: Path | None) -> None:
    from handeye.trials.insertion_page import page

    if out is not None:
        _write(out, bench, title)
    if json:
        put_json({"figures": list(bench.figures())})
    else:
        screen.print(page(bench))


def _conditions(
    clearance: float | None, chamfer: float | None, sd: float | None, search: Literal["gentle", "1973"]
) -> "list[Condition]":
    """The condition that is asked for, or the grid.

    Raises:
        InvalidInput: it cannot be tried.
    """
    from handeye.trials.insertion import Condition, grid

    if clearance is None and chamfer is None and sd is None:
        return grid(search)
    asked = {"clearance": clearance, "chamfer": chamfer, "sd": sd}
    for (name, value), (least, most) in zip(
        asked.items(), ((0.05, 1.0), (0.0, 2.0), (0.0, MOST_SD)), strict=True
    ):
        if value is not None and not least <= value <= most:
            raise BadArgument(f"--{name} can be {least:g} to {most:g} mm; {value:g} is not")
    return [Condition(search=search, **{name: value for name, value in asked.items() if value is not None})]


def _kind(out: Path) -> Kind:
    from handeye.trials.insertion_page import PAGE, ROWS

    kinds = {kind.ending: kind for kind in (PAGE, ROWS)}
    if out.suffix.lower() not in kinds:
        raise BadArgument(f"{out}: the name must end in .html (a page with drawings) or .csv (all trials)")
    return kinds[out.suffix.lower()]


def _write(out: Path, bench: "Bench", title: str) -> None:
    from handeye.trials.insertion_page import PAGE, html, rows

    kind = _kind(out)
    write_over(out, html(bench, title) if kind is PAGE else rows(bench), kind)
