"""Parts common to all commands that run a sweep: options, progress, the folder, and the summary at the end. A sweep is
a series of trials.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any, Final, Literal

from cyclopts import Parameter

from handeye.cli.common import Json, WholeNumber, note, notes, positive, put_json, say, screen
from handeye.cli.tally import Tally
from handeye.cli.world_options import WORLD
from handeye.core.errors import BadArgument
from handeye.core.files import check_place, unguarded, write_over
from handeye.core.host_time import HostTimer
from handeye.core.plain_text import counted

if TYPE_CHECKING:
    from handeye.planfile.plan import Plan
    from handeye.trials.figures import Figures
    from handeye.trials.folder import Head
    from handeye.trials.sweep import Case, Engine, Sweep, TrialRow, Work

FIGURES, TABLES = "figures.html", "tables"
ROWS: Final = ".csv"


FirstSeed = Annotated[
    WholeNumber, Parameter(group=WORLD, help="Seed of the world of trial 0; trial K has this seed plus K.")
]


@Parameter(name="*")
@dataclass(frozen=True, slots=True, kw_only=True)
class SweepOptions:
    """Options of every sweep, except number and seed."""

    jobs: Annotated[WholeNumber, Parameter(help="Number of processes that work at the same time.")] = 2
    out: Annotated[
        Path | None,
        Parameter(
            name=["--out", "-o"],
            help="Folder of the batch. Each trial is saved as it ends, so that the same command continues an "
            "interrupted batch; figures.html is written at the end. If --out is a file, only the page (.html) or the "
            "table of trials (.csv) is written.",
        ),
    ] = None
    tables: Annotated[
        Literal["csv", "parquet"] | None,
        Parameter(help="With --out: also write the figures as tables, into the subfolder `tables`."),
    ] = None
    overwrite: Annotated[
        bool, Parameter(help="Replace the file given by --out; if --out is a folder, discard its trials.")
    ] = False
    json: Json = False

    @property
    def folder(self) -> Path | None:
        """The folder in which trials are saved; None if there is none."""
        return None if self.out is None or self.out.suffix.lower() in (".html", ROWS) else self.out

    def check(self) -> None:
        """Raises InvalidInput, before the trials begin, if it would be impossible to write their results."""
        from handeye.trace.tables import check_tables
        from handeye.trials.page import PAGE
        from handeye.trials.tables import ROWS as TABLE

        positive(self.jobs, "process")
        if self.tables is not None and self.folder is None:
            raise BadArgument("--tables needs --out, the folder to which the tables are written")
        if self.out is None:
            return
        if self.folder is None:
            kind = PAGE if self.out.suffix.lower() == ".html" else TABLE
            check_place(self.out, kind, overwrite=self.overwrite)
            return
        if not self.out.is_dir():
            return
        check_place(self.out / FIGURES, PAGE)
        if self.tables is not None:
            check_tables(self.out / TABLES, self.tables)


ANY: Final = SweepOptions()


def carry_out_sweep(
    sweep: "Sweep[Any]",
    work: "Work[Any]",
    cases: "Sequence[Case]",
    head: "Head",
    options: SweepOptions,
    *,
    title: str,
    plan: "Plan | None" = None,
    again: "Callable[[Any], str]" = lambda _: "",
    engine: "Engine | None" = None,
    more: Mapping[str, object] | None = None,
) -> int:
    """Run a sweep: save and report each trial as it ends, then print the figures, even if the sweep was interrupted;
    returns the exit code.

    Args:
        again: a function that gives the command to repeat the trial of a row.
        more: further fields of the JSON.
    """
    from handeye.trials.figures import figures
    from handeye.trials.folder import BatchFolder
    from handeye.trials.sweep import carry_out, processes

    wanted = {(case.condition, number) for case in cases for number in case.trials}
    folder = (
        None
        if options.folder is None
        else BatchFolder(options.folder, sweep, head, plan, anew=options.overwrite)
    )
    if folder is not None and folder.unlocked:
        note(unguarded(folder.path, folder.unlocked))
    timer = HostTimer()
    rows: dict[tuple[str, int], TrialRow] = {}
    try:
        options.check()
        if folder is not None:
            rows = {key: row for key, row in folder.rows.items() if key in wanted}
        with _Progress(sweep, len(wanted), list(rows.values()), timer, json=options.json) as progress:

            def told(row: "TrialRow") -> None:
                rows[row.key] = row
                progress.tell(row)

            carry_out(sweep, work, cases, engine or processes(options.jobs), folder=folder, told=told)
    except BaseException:
        if folder is not None:
            note(
                f"{counted(len(folder.rows), 'trial')} saved in {options.out}; the same command continues the batch"
            )
        raise
    finally:
        if folder is not None:
            folder.close()
        ordered = [
            rows[case.condition, k] for case in cases for k in case.trials if (case.condition, k) in rows
        ]
        found = figures(sweep, ordered, again, wall_s=timer.wall_s)
        if ordered:
            _tell(sweep, ordered, found, options, title, more or {}, head.camera)
        again_later = sum(row.to_be_tried_again for row in ordered)
        if folder is not None and again_later:
            note(
                f"{counted(again_later, 'trial')} ended because this computer failed; run the same command again to "
                "repeat them"
            )
    return found.exit_code


def _tell(
    sweep: "Sweep[Any]",
    rows: "Sequence[Any]",
    found: "Figures",
    options: SweepOptions,
    title: str,
    more: Mapping[str, object],
    camera: str,
) -> None:
    """Write the page and the tables of a batch, and print its figures."""
    from handeye.trace.tables import csv_bytes, write_tables
    from handeye.trials.page import PAGE, sweep_page
    from handeye.trials.tables import ROWS as TABLE
    from handeye.trials.tables import tables, trials

    if options.out is not None and options.out.suffix.lower() == ROWS:
        write_over(options.out, csv_bytes(trials(sweep, rows, camera)), TABLE)
    elif options.out is not None:
        page = options.out if options.folder is None else options.out / FIGURES
        write_over(page, sweep_page(title, sweep, rows, found), PAGE)
    if options.folder is not None and options.tables is not None:
        made = tables(sweep, rows, found, camera)
        write_tables(options.folder / TABLES, made, options.tables, "Figures are in the unit of their column")
    if options.json:
        put_json({**json_of(sweep, rows, found), **more})
        return
    from handeye.trials.text import page as text

    screen.print(text(sweep, rows, found), soft_wrap=True)


def json_of(sweep: "Sweep[Any]", rows: "Sequence[Any]", found: "Figures") -> dict[str, object]:
    """The figures of a sweep, for JSON."""
    from msgspec.structs import asdict

    return asdict(found) | {each.name: each.rows for each in sweep.details(rows)} | dict(sweep.more(rows))


class _Progress(Tally):
    """Counts and reports trials as they end."""

    def __init__(
        self, sweep: "Sweep[Any]", total: int, kept: "list[Any]", timer: HostTimer, *, json: bool
    ) -> None:
        super().__init__(total, f"{sweep.noun}s", silent=sweep.narrated, kept=len(kept))
        self._sweep, self._rows, self._timer = sweep, list(kept), timer
        self._to = notes if json else screen
        if kept:
            note(f"{len(kept)} of {counted(total, sweep.noun)} already done by an earlier command")
        for row in kept:
            self._say(row)

    def tell(self, row: "TrialRow") -> None:
        """Count a trial that has ended, and report it."""
        self._rows.append(row)
        with self.aside():
            self._say(row)
            if self._sweep.narrated:
                self._narrate(row)
        self.one_more()

    def _say(self, row: "TrialRow") -> None:
        said = "" if self._sweep.sentence is None else self._sweep.sentence(row)
        for line in said.splitlines():
            say(line, self._to, whole=line.startswith("  "))

    def _narrate(self, row: "TrialRow") -> None:
        from handeye.trials.text import told_so_far

        done = len(self._rows)
        left = self._timer.wall_s / (done - self._kept) * (self._total - done)
        soon = f"{left:.0f} s" if left < 100 else f"{left / 60:.0f} min"
        rate = told_so_far(self._sweep, self._rows)
        note(
            f"{done:4} of {self._total}  seed {row.seed:4}  {row.verdict:9}  {rate}, {soon} left"
            f"{row.detail and '  '}{row.detail}"
        )


def sweep_command(sweep: "Sweep[Any]", n: int = 10) -> Callable[..., int]:
    """Make a command that runs a sweep, for use in the entry of a system. The sweep has no options of its own; by
    default, the command runs `n` trials.
    """

    def command(
        *,
        number: Annotated[WholeNumber, Parameter(name="--n", help="Number of trials.")] = n,
        seed: Annotated[WholeNumber, Parameter(help="Seed of trial 0; trial K has this seed plus K.")] = 0,
        options: SweepOptions = ANY,
    ) -> int:
        from handeye.core.variation import WorldSpec, checked_seed
        from handeye.trials.folder import head_of
        from handeye.trials.sweep import cases

        positive(number, sweep.noun)
        options.check()
        if sweep.work is None:
            raise BadArgument(f"trials of the kind {sweep.kind} need options; use their own command")
        world = WorldSpec(seed=checked_seed(seed))
        title = f"{sweep.kind} in worlds with seeds from {seed} upwards"
        return carry_out_sweep(
            sweep, sweep.work, cases(seed, range(number)), head_of(sweep, world), options, title=title,
            again=lambda row: f"handeye trials {sweep.kind} --n 1 --seed {row.seed}",
        )  # fmt: skip

    told = f"Run {sweep.kind} trials in many worlds, and count the outcomes."
    command.__doc__ = (
        f"{told}\n\nExit code 0: no silent failure; 1: no trial finished; 3: there was a silent failure."
    )
    return command
