"""The command that compares the languages stage by stage."""

import shlex
from collections.abc import Iterable, Sequence
from contextlib import ExitStack
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from handeye.cli.common import Camera, WholeNumber, camera_here, positive
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions, carry_out_sweep
from handeye.cli.tally import Tally
from handeye.cli.world_options import ANY_OWN_ERRORS, OwnErrorOptions
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument

if TYPE_CHECKING:
    from handeye.runs.setup import Setup
    from handeye.systems.relay.stages.languages import StageLeg
    from handeye.trials.sweep import Case

Language = Literal["1973", "TRIG", "ML", "MAL"]


def stages(
    *,
    stage: Annotated[
        list[str] | None,
        Parameter(
            help="Name of a stage of the pump’s own program; may be repeated. Default: the stages for which there "
            "are programs in several languages.",
            consume_multiple=False,
        ),
    ] = None,
    language: Annotated[
        list[Language] | None,
        Parameter(
            help="Language of the legs; may be repeated. 1973 is the arm language. Default: all languages that can "
            "do the stage.",
            consume_multiple=False,
        ),
    ] = None,
    n: Annotated[WholeNumber, Parameter(name="--n", help="Number of worlds.")] = 10,
    seed: FirstSeed = 0,
    checkpoints: Annotated[
        Path | None,
        Parameter(
            help="Folder that keeps the careful program’s run in each world; a missing run is made first. Default: a "
            "temporary folder."
        ),
    ] = None,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    camera: Camera = "auto",
    options: SweepOptions = ANY,
) -> int:
    """Do stages of the pump in several languages, from the same state in each world.

    In each world, and for each stage, the careful program (`water_pump.al`) first does all earlier stages. A program
    in each language then continues from this state and does the stage, and the referee judges the pump as it is after
    the stage. The figures are: how often the referee accepted the stage, how often the stage failed silently, the
    arm's time, the peak of the force, the number of lines of the program, and the CPU time to plan the program. Each
    pair of languages is compared in the worlds in which both were tried. A table says which stages only the arm
    language can express, and why.

    In each world, the careful program takes about 20 CPU seconds, and each stage takes another three to ten CPU
    seconds. Ctrl-C ends the batch and prints the trials that have finished. If you gave --out, repeat the command to
    continue the batch; you can then also add worlds, stages and languages.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure; 2: bad input; 130: interrupted.
    """
    from handeye.core.variation import checked_seed
    from handeye.runs.setup import Setup
    from handeye.systems.relay.plan import TASK
    from handeye.systems.relay.stages.languages import digest, programs, relay_of
    from handeye.systems.relay.stages.trials import STAGES, StageWork
    from handeye.trials.folder import head_of
    from handeye.trials.sweep import Case

    positive(n, "world")
    checked_seed(seed + n - 1)
    options.check()
    legs = {leg.condition: leg for leg in _chosen(stage, language)}
    known = programs(legs.values())
    careful = Setup(
        system="relay",
        plan=relay_of(_careful(legs.values()), known),
        world=errors.of(TASK).spec(seed),
        camera=camera_here(camera),
    )
    cases = [Case(trials=(k,), seed=seed + k, condition=each) for k in range(n) for each in legs]
    with ExitStack() as stack:
        folder = checkpoints or Path(stack.enter_context(TemporaryDirectory()))
        _run_careful(careful, folder, cases, options)
        return carry_out_sweep(
            STAGES,
            StageWork(careful=careful, folder=folder, legs=legs, programs=known),
            cases,
            head_of(STAGES, careful.world, settings={"programs": digest()}, camera=careful.camera),
            options,
            title=f"Stages of the pump by language, in worlds with seeds from {seed} upwards",
            again=lambda row: shlex.join(
                ["handeye", "trials", "stages", "--stage", row.of, "--language", row.language, *errors.words(),
                 "--n", "1", "--seed", str(row.seed)]
            ),
        )  # fmt: skip


def _chosen(names: Sequence[str] | None, languages: Sequence[str] | None) -> "list[StageLeg]":
    """Return the legs that do the named stages in the named languages. Raises InvalidInput if a stage has no leg."""
    from handeye.systems.relay.stages.languages import WITHOUT_LEG, shared, stage_legs, stage_named

    found = []
    for name in dict.fromkeys(shared() if names is None else map(stage_named, names)):
        legs = [leg for leg in stage_legs(name) if languages is None or leg.language in languages]
        if not legs and names is not None:
            asked = [*(languages or ())]
            why = next((f": {WITHOUT_LEG[name, each]}" for each in asked if (name, each) in WITHOUT_LEG), "")
            raise BadArgument(f"the stage {quoted(name)} has no leg in {' or '.join(asked)}{why}")
        found += legs
    return found


def _careful(legs: "Iterable[StageLeg]") -> "StageLeg":
    """Return a leg of the careful program. The stage of this leg is the last stage of `legs`, or the last stage that
    several languages can do, whichever is later.
    """
    from handeye.systems.relay.stages.languages import shared, stage_legs, stages

    last = max([*shared(), *(leg.stage for leg in legs)], key=stages().index)
    return next(iter(stage_legs(last)))


def _run_careful(careful: "Setup", folder: Path, cases: "Sequence[Case]", options: SweepOptions) -> None:
    """Run the careful program in each world in which a trial is missing. If the folder already contains the careful
    program's run in a world, this run is not repeated.
    """
    from msgspec.structs import replace

    from handeye.trials.folder import kept_trials
    from handeye.trials.sound_run import sound_runs

    done = kept_trials(options.folder) if options.folder is not None and not options.overwrite else set()
    seeds = dict.fromkeys(case.seed for case in cases if (case.condition, *case.trials) not in done)
    worlds = [replace(careful.world, seed=seed) for seed in seeds]
    runs = sound_runs(careful, folder, worlds, options.jobs, every=None)
    for _ in Tally(len(worlds), "worlds prepared").counting(runs):
        pass
