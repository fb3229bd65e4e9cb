"""The commands of the jobs with bars, for one world and for many worlds."""

from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import WholeNumber
from handeye.cli.judged_jobs import ANY_FAULTY_RUN, FaultyJobOptions
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions
from handeye.cli.world_options import ANY_OWN_ERRORS, OwnErrorOptions
from handeye.core.plain_text import counted
from handeye.systems.ml.cli.jobs import (
    JobSeed,
    NumberOfWorlds,
    carry_out,
    carry_out_trials,
    plan_with_parts,
)

Parts = Annotated[WholeNumber, Parameter(help="Number of parts in the bin, from 1 to 12.")]


def orient(
    *, seed: JobSeed = 0, errors: OwnErrorOptions = ANY_OWN_ERRORS, options: FaultyJobOptions = ANY_FAULTY_RUN
) -> int:
    """Take a bar whose attitude is unknown, and turn it by touch into a known attitude.

    `plans/orient.ml` takes the bar out of a cradle, in which the bar is pitched by up to 50 degrees and turned by up
    to 25 degrees. The program puts the bar down with a guarded move, which stops at a contact. Then the program lets
    the bar fall flat, and grasps the bar again. To learn where the bar is, the program moves the end of the bar
    against a stop; then it grasps the bar in the middle. A referee checks that the fingers hold the bar, and that the
    bar is within 3 degrees of the required attitude and within 1 mm of the required place.

    Exit code 0: right; 1: the program has stopped before its end; 3: it has ended, but the referee disagrees; 2: bad
    input; 130: interrupted.
    """
    from handeye.systems.ml.run.jobs import job_plan

    return carry_out(job_plan("orient"), seed, errors, options)


def orient_trials(
    *,
    n: NumberOfWorlds = 10,
    seed: FirstSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Orient a bar in many worlds. Shows the errors of the bar's attitude and place, and how often both are right.

    Each trial does what `handeye ml orient` does. Ctrl-C ends the batch and prints the trials that have finished. If
    you gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
    the referee disagrees.
    """
    from handeye.systems.ml.run.job_trials import ORIENT_TRIALS
    from handeye.systems.ml.run.jobs import job_plan

    return carry_out_trials(
        ORIENT_TRIALS, job_plan("orient"), n, seed, errors, options, title="a bar oriented"
    )


def take_from_bin(
    *,
    parts: Parts = 8,
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: FaultyJobOptions = ANY_FAULTY_RUN,
) -> int:
    """Take parts of one kind out of a bin, one at a time, and judge each by its width and weight.

    `plans/bin.ml` finds the highest parts with the range finder, and grasps them with guarded moves, which stop at a
    contact. From the separation and the strain of the fingers, the program learns whether the hand holds one good
    part, one bad part, no part or several parts. The program puts good parts into one box and bad parts into another,
    until the range finder shows that the bin is empty. A referee then checks that each part is in the right box, and
    that no part is left in the bin or lies elsewhere.

    Exit code 0: right; 1: the program has stopped because it could not get a part, or has lost one; 3: it has ended,
    but the referee disagrees; 2: bad input; 130: interrupted.
    """
    return carry_out(plan_with_parts("bin", parts), seed, errors, options)


def bin_trials(
    *,
    n: NumberOfWorlds = 10,
    seed: FirstSeed = 0,
    parts: Parts = 8,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Take parts out of a bin in many worlds. Shows how often all parts are taken out and judged correctly, and why
    the other trials fail.

    Each trial does what `handeye ml bin` does. Ctrl-C ends the batch and prints the trials that have finished. If you
    gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
    the referee disagrees.
    """
    from handeye.systems.ml.run.job_trials import BIN_TRIALS

    return carry_out_trials(
        BIN_TRIALS, plan_with_parts("bin", parts), n, seed, errors, options,
        title=f"a bin of {counted(parts, 'part')}", again=f"--parts {parts}",
    )  # fmt: skip
