"""The commands of the curve follower, for one world and for many worlds."""

from typing import Annotated

from cyclopts import Parameter

from handeye.cli.judged_jobs import ANY_FAULTY_RUN, FaultyJobOptions
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions
from handeye.cli.world_options import ANY_OWN_ERRORS, OwnErrorOptions
from handeye.systems.ml.cli.jobs import (
    JobSeed,
    NumberOfWorlds,
    carry_out,
    carry_out_trials,
)
from handeye.systems.ml.follow.names import OutlineName

Outline = Annotated[OutlineName, Parameter(help="The plate that lies on the table.")]


def follow(
    *,
    outline: Outline = "square",
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: FaultyJobOptions = ANY_FAULTY_RUN,
) -> int:
    """Follow the outline of a plate by touch, with the program of the paper of 1975. A wand signals when it touches the
    plate.

    `plans/curve_follower.ml` is figure 5 of the paper as printed, and never ends by itself. The run ends when the wand
    has gone around the plate once (the circuit is closed), or when the follower is lost, for example because the wand
    no longer touches anything. A referee then compares the touches with the true outline, and checks whether the plate
    has moved.

    Exit code 0: right; 1: the follower is lost, or the program was stopped; 3: the circuit is closed, but the referee
    disagrees; 2: bad input; 130: interrupted.
    """
    from handeye.systems.ml.run.jobs import job_plan

    return carry_out(job_plan("follow", outline), seed, errors, options)


def follow_trials(
    *,
    n: NumberOfWorlds = 10,
    seed: FirstSeed = 0,
    outline: Outline = "square",
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Follow an outline in many worlds. Shows the errors of the touches, and how often the outline is followed
    correctly.

    Each trial does what `handeye ml follow` does. Ctrl-C ends the batch and prints the trials that have finished. If
    you gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the circuit is closed but
    the referee disagrees.
    """
    from handeye.systems.ml.run.job_trials import FOLLOW_TRIALS
    from handeye.systems.ml.run.jobs import job_plan

    return carry_out_trials(
        FOLLOW_TRIALS, job_plan("follow", outline), n, seed, errors, options,
        title=f"follow, outline {outline}", again=f"--outline {outline}",
    )  # fmt: skip
