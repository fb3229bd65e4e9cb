"""The commands of the hand-over: one board, and many."""

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions
from handeye.cli.world_options import ANY_OWN_ERRORS, OwnErrorOptions
from handeye.systems.sigma.cli.jobs import (
    ANY_RUN,
    JobOptions,
    JobSeed,
    NumberOfBoards,
    carry_out,
    carry_out_trials,
    job_or_own_plan,
)

Program = Annotated[
    Path | None, Parameter(help="A program in MAL for the same board, `.mal`, instead of handeye's program.")
]


def handover(
    file: Program = None,
    /,
    *,
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: JobOptions = ANY_RUN,
) -> int:
    """Hand four pieces from arm to arm: arm 1 brings them, arm 2 presses their pins in and takes them away.

    `plans/handover_pieces.mal` runs on two simulated gantries in a world drawn from a seed. A referee then checks
    that each piece stands at its last place, within 3 mm and 3 degrees, with its pin pressed in to within .5 mm;
    that the program counted the finished pieces correctly; and that the arms never touched each other.

    Exit code 0: right; 1: the program stopped before its end, for example at a deadlock or because the arms
        collided; 3: the program ended, but the referee disagrees; 2: bad input; 130: interrupted.
    """
    from handeye.systems.sigma.handover.pieces import MOST

    plan = job_or_own_plan("handover", MOST, file)
    return 2 if plan is None else carry_out(plan, seed, errors, options)


def handover_trials(
    *,
    n: NumberOfBoards = 10,
    seed: FirstSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Hand four pieces from arm to arm on many boards: how often all is right, errors of places, and load of the bus.

    Each trial does what `handeye sigma handover` does. Ctrl-C ends the batch and prints the trials that have
    finished; with --out, the same command continues the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
        the referee disagrees.
    """
    from handeye.systems.sigma.handover.pieces import MOST
    from handeye.systems.sigma.run.job_trials import HANDOVER_TRIALS
    from handeye.systems.sigma.run.jobs import job_plan

    return carry_out_trials(
        HANDOVER_TRIALS, job_plan("handover", MOST), n, seed, errors, options,
        title="hand-over of four pieces",
    )  # fmt: skip
