"""`handeye trials rare` and `handeye trials worst`: failures that are too rare to be counted."""

import shlex
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final, Literal

from cyclopts import Parameter

from handeye.cli.batches import PlanOption, trial_engine
from handeye.cli.common import (
    Camera,
    Json,
    WholeNumber,
    camera_here,
    note,
    notes,
    positive,
    put_json,
    say,
    screen,
)
from handeye.cli.programs import plan_or_own
from handeye.cli.sweeps import FirstSeed
from handeye.cli.world_options import ANY_ERRORS, ErrorOptions
from handeye.core.errors import BadArgument
from handeye.core.files import check_place, unguarded, write_over
from handeye.core.plain_text import counted
from handeye.core.variation import LARGEST_SEED, checked_seed
from handeye.tasks import option, planned

if TYPE_CHECKING:
    from handeye.trials.rare.campaign import Campaign, Estimated
    from handeye.trials.rare.row import FailureKind, RareRow
    from handeye.trials.rare.subset import Level

_PAGE: Final = "rare.html"
_WORST: Final = "worst.html"
_LEAST: Final = 20  # runs of a level; its tenth are the chains of the next


@Parameter(name="*")
@dataclass(frozen=True, slots=True, kw_only=True)
class SampleOptions:
    """The options of a search for rare failures."""

    n: Annotated[WholeNumber, Parameter(help=f"Number of runs of each level, at least {_LEAST}.")] = 250
    levels: Annotated[
        WholeNumber,
        Parameter(
            help="Greatest number of levels. Each level reaches worlds that are about ten times rarer than those of "
            "the level before."
        ),
    ] = 6
    failure: Annotated[
        Literal["stopped", "silent"] | None,
        Parameter(help="Look only for this kind of failure. Default: for both kinds, one after the other."),
    ] = None
    seed: FirstSeed = 0
    errors: Annotated[ErrorOptions, Parameter(name="*")] = ANY_ERRORS
    plan: PlanOption = None
    engine: Annotated[
        Literal["process", "dask"],
        Parameter(help="Where runs are made: in processes on this computer, or on dask workers."),
    ] = "process"
    scheduler: Annotated[
        str | None,
        Parameter(
            help="With --engine dask: address of a scheduler. Default: start workers on this computer."
        ),
    ] = None
    camera: Camera = "auto"
    jobs: Annotated[WholeNumber, Parameter(help="Number of processes that work at the same time.")] = 2
    out: Annotated[
        Path | None,
        Parameter(
            name=["--out", "-o"],
            help="Folder of the search. Each run is saved as it ends, so that the same command continues an "
            "interrupted search; the worlds in which the program fails are saved in its subfolder `worlds`.",
        ),
    ] = None
    overwrite: Annotated[bool, Parameter(help="Discard the runs in the folder given by --out.")] = False
    json: Json = False

    @property
    def kinds(self) -> "tuple[FailureKind, ...]":
        """The kinds of failures to look for."""
        from handeye.trials.rare.row import KINDS

        return KINDS if self.failure is None else (self.failure,)

    def check(self) -> None:
        """Raises InvalidInput if an option cannot be used."""
        if self.n < _LEAST:
            raise BadArgument(f"--n must be at least {_LEAST}, not {self.n}")
        for count, what in ((self.n, "run"), (self.levels, "level"), (self.jobs, "process")):
            positive(count, what)
        if self.scheduler is not None and self.engine != "dask":
            raise BadArgument("--scheduler needs --engine dask")
        if checked_seed(self.seed) > LARGEST_SEED - self.n:
            raise BadArgument(
                f"there are fewer than {self.n} seeds from --seed {self.seed} to the largest seed, {LARGEST_SEED}"
            )
        if self.out is not None and self.out.suffix.lower() in (".html", ".csv", ".json"):
            raise BadArgument(f"--out {self.out} looks like a file; a search needs a folder")

    @contextmanager
    def campaign(self, page: str) -> "Iterator[_Search]":
        """Begin or continue a search. A status line on stderr gives the number of the current run."""
        from handeye.trials.folder import BatchFolder, head_of
        from handeye.trials.rare.campaign import Campaign, forget_worlds
        from handeye.trials.rare.page import PAGE
        from handeye.trials.rare.points import WorldSpace
        from handeye.trials.rare.row import RARE, RareTrial

        self.check()
        if self.plan is None:
            self.errors.check(self.seed)
        record = plan_or_own(self.plan, self.errors.task)
        errors, spared = self.errors.of(record.task).apart(record.program.calls)
        world, work = errors.spec(self.seed), planned(errors.work)
        work.check_arm(record)
        camera = camera_here(self.camera)
        trial = RareTrial(plan=record, world=world, camera=camera, without=spared)
        head = head_of(
            RARE, world, record, {"runs of a level": str(self.n)}, camera=camera, without=spared,
            simulated_limit_s=trial.simulated_limit_s,
        )  # fmt: skip
        if self.out is not None and self.out.is_dir():
            check_place(self.out / page, PAGE)
        folder = None if self.out is None else BatchFolder(self.out, RARE, head, record, anew=self.overwrite)
        if folder is not None and folder.unlocked:
            note(unguarded(folder.path, folder.unlocked))
        if folder is not None and self.overwrite:
            forget_worlds(folder.path)
        try:
            with notes.status("beginning") as status:
                made = Campaign(
                    trial=trial, space=WorldSpace(work.variation(), world), runs=self.n,
                    engine=trial_engine(self.engine, self.jobs, self.scheduler), folder=folder,
                    told=lambda row: status.update(f"{row.condition}, run {row.trial + 1}"),
                )  # fmt: skip
                yield _Search(
                    options=self, campaign=made, title=f"{record.program.name} in worlds from {world} on"
                )
        except BaseException:
            if folder is not None:
                note(
                    f"{counted(len(folder.rows), 'run')} saved in {self.out}; the same command continues the search"
                )
            raise
        finally:
            if folder is not None:
                folder.close()


@dataclass(frozen=True, slots=True, kw_only=True)
class _Search:
    """A search in progress."""

    options: SampleOptions
    campaign: "Campaign"
    title: str

    def estimates(self) -> "list[Estimated]":
        """Estimate the probability of each kind of failure; each level is reported on standard error."""
        found = []
        for kind in self.options.kinds:

            def told(level: "Level", kind: str = kind) -> None:
                note(
                    f"{kind}, level {level.number}: {counted(level.runs, 'new run')}, margin at most "
                    f"{level.threshold:.3g} in {100 * level.share:.0f} %, {level.failed} failed"
                )

            found.append(self.campaign.estimated(kind, self.options.levels, told))
        return found

    def write(self, page: str, content: bytes) -> None:
        """Write a page into the folder, if there is one."""
        from handeye.trials.rare.page import PAGE

        if self.options.out is not None:
            write_over(self.options.out / page, content, PAGE)

    def name_first(self, files: "Sequence[str]") -> None:
        """Print the command that runs the program in the first of the given worlds. Each world is given by its file in
        the folder.
        """
        if not files or self.options.out is None:
            return
        from handeye.report.facts.again import sense_words

        trial = self.campaign.trial
        command = ["assemble"] if self.options.plan is None else ["run", str(self.options.plan), "--judge"]
        words = [*command, *option(trial.plan.task), *sense_words(trial.without)]
        place = ["--world", f"{self.options.out}/{files[0]}", "--camera", trial.camera]
        say(f"{counted(len(files), 'failing world')} in {self.options.out}/worlds; the first:")
        say(f"  {shlex.join(['handeye', *words, *place])}", whole=True)

    @property
    def exit_code(self) -> int:
        return 3 if any(row.failure == "silent" for row in self.campaign.rows) else 0


ANY_SAMPLE: Final = SampleOptions()


def rare_trials(*, options: SampleOptions = ANY_SAMPLE) -> int:
    """Estimate, by subset simulation, how rarely a program stops, and how rarely it fails silently.

    The worlds of the first level are made from seeds. From each level, the search takes one tenth of the worlds: those
    in which the program comes closest to failing. The next level is a sample of worlds in which the program comes at
    least this close to failing. The estimate of the probability is a product: one tenth for each level except the
    last, times the fraction of worlds of the last level in which the program fails. This estimate is not an upper
    bound. Whether the program fails in a world is always found by a run in that world, never estimated.

    Exit code 0: no silent failure; 3: in some world, the program reported success but the referee disagreed; 2: bad
    input; 130: interrupted.
    """
    from handeye.trials.rare.campaign import WORLDS, file_of
    from handeye.trials.rare.page import estimates, rare_page
    from handeye.trials.rare.text import levels_table, sentence

    with options.campaign(_PAGE) as search:
        found = search.estimates()
        failing = [(each.kind, each.row, f"{WORLDS}/{file_of(each.row)}") for each in search.campaign.failing]
        search.write(_PAGE, rare_page(search.title, "Rare failures", [*estimates(found)]))
    if options.json:
        put_json(
            {
                "runs": len(search.campaign.rows),
                "estimates": found,
                "failing": [_failing(row, file if options.out else "") for _, row, file in failing],
            }
        )
        return search.exit_code
    for each in found:
        screen.print(levels_table(each), soft_wrap=True)
        say(f"\n{sentence(each)}")
        search.name_first([file for kind, _, file in failing if kind == each.failure])
    return search.exit_code


def worst_trials(
    *,
    nearest: Annotated[
        WholeNumber,
        Parameter(
            help=(
                "Number of further searches, for failing worlds with even smaller errors. Each search starts from "
                "one of the failing worlds with the smallest errors found so far."
            )
        ),
    ] = 5,
    rounds: Annotated[
        WholeNumber, Parameter(help="Greatest number of runs in the search from one failing world.")
    ] = 24,
    options: SampleOptions = ANY_SAMPLE,
) -> int:
    """Find the failing worlds whose errors are smallest, and the quantities that make the program fail.

    The levels are those of `trials rare`, so this command can continue the work in a folder that `trials rare` wrote.
    In each of the nearest failing worlds, the command then sets the quantities back to the middle of their ranges,
    except those whose deviation is needed for the failure.

    Exit code 0: no silent failure; 3: in some world, the program reported success but the referee disagreed; 2: bad
    input; 130: interrupted.
    """
    from handeye.trials.rare.nearest import nearest as search_nearest
    from handeye.trials.rare.nearest import pushes
    from handeye.trials.rare.page import estimates, rare_page, worlds
    from handeye.trials.rare.text import no_worlds, pushes_table, worlds_table

    positive(nearest, "world")
    positive(rounds, "run")
    with options.campaign(_WORST) as search:
        estimated, campaign = search.estimates(), search.campaign
        found = {kind: search_nearest(campaign, kind, nearest, rounds) for kind in options.kinds}
        pushing = {kind: pushes(campaign, kind, each) for kind, each in found.items()}
        sections = [part for kind, each in found.items() for part in worlds(kind, each, pushing[kind])]
        search.write(
            _WORST, rare_page(search.title, "Nearest failing worlds", [*sections, *estimates(estimated)])
        )
    if options.json:
        put_json(
            {
                "runs": len(campaign.rows),
                "worlds": [world for each in found.values() for world in each],
                "pushes": pushing,
                "estimates": estimated,
            }
        )
        return search.exit_code
    for kind, each in found.items():
        if not each:
            say(no_worlds(kind))
            continue
        screen.print(worlds_table(each), soft_wrap=True)
        say("")
        screen.print(pushes_table(pushing[kind]), soft_wrap=True)
        search.name_first([world.file for world in each])
    return search.exit_code


def _failing(row: "RareRow", file: str) -> dict[str, object]:
    return {
        "failure": row.failure, "condition": row.condition, "trial": row.trial, "seed": row.seed,
        "stage": row.stage, "detail": row.detail, "file": file,
    }  # fmt: skip
