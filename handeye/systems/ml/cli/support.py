"""The commands of the rail support, for one world and for many worlds."""

from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import WholeNumber
from handeye.cli.judged_jobs import ANY_FAULTY_RUN, FaultyJobOptions
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions
from handeye.cli.world_options import ANY_OWN_ERRORS, OwnErrorOptions
from handeye.systems.ml.cli.jobs import JobSeed, NumberOfWorlds, carry_out, carry_out_trials, plan_with_parts


def support(
    *, seed: JobSeed = 0, errors: OwnErrorOptions = ANY_OWN_ERRORS, options: FaultyJobOptions = ANY_FAULTY_RUN
) -> int:
    """Assemble the rail support of a typewriter from 22 parts by touch.

    `plans/support.sym` takes a frame, two rails, four pins and five saddles from their pallets, and puts each part
    into its place. The program presses on each part to learn whether the part is down in its place. Then the program
    fetches a power screwdriver, drives ten screws, and puts the screwdriver back. The program accepts a screw if the
    depth of the bit and the torque of the clutch are right. A referee checks whether all 22 parts are right, and
    whether the program has counted the parts correctly.

    Exit code 0: right; 1: the program has stopped before its end; 3: it has ended, but the referee disagrees; 2: bad
    input; 130: interrupted.
    """
    from handeye.systems.ml.run.jobs import job_plan

    return carry_out(job_plan("support"), seed, errors, options)


def support_trials(
    *,
    n: NumberOfWorlds = 10,
    seed: FirstSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Assemble the rail support in many worlds. Shows the errors of the 22 parts, and how often all parts are right.

    Each trial does what `handeye ml support` does. Ctrl-C ends the batch and prints the trials that have finished. If
    you gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
    the referee disagrees.
    """
    from handeye.systems.ml.run.job_trials import SUPPORT_TRIALS
    from handeye.systems.ml.run.jobs import job_plan

    return carry_out_trials(
        SUPPORT_TRIALS, job_plan("support"), n, seed, errors, options, title="the rail support"
    )


Bars = Annotated[WholeNumber, Parameter(help="Number of bars in the bin, from 1 to 12.")]


def typewriter(
    *,
    bars: Bars = 4,
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: FaultyJobOptions = ANY_FAULTY_RUN,
) -> int:
    """Take a bar out of a bin, orient it, put it into the frame of the rail support, and assemble the support.

    `plans/typewriter.sym` does in one program what `bin`, `orient` and `support` do. It takes bars out of the bin
    until one is neither too narrow nor too light. It learns the bar's attitude and place by touch, and puts the bar
    into the frame. Then it continues with the statements of `plans/support.sym`. A referee checks the 22 parts and the
    bar.

    Exit code 0: right; 1: the program has stopped before its end; 3: it has ended, but the referee disagrees; 2: bad
    input; 130: interrupted.
    """
    return carry_out(plan_with_parts("typewriter", bars), seed, errors, options)


def typewriter_trials(
    *,
    n: NumberOfWorlds = 10,
    seed: FirstSeed = 0,
    bars: Bars = 4,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Take a bar out of a bin, orient it and assemble the rail support with it, in many worlds.

    Each trial does what `handeye ml typewriter` does. Ctrl-C ends the batch and prints the trials that have finished.
    If you gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
    the referee disagrees.
    """
    from handeye.systems.ml.run.job_trials import TYPEWRITER_TRIALS

    return carry_out_trials(
        TYPEWRITER_TRIALS, plan_with_parts("typewriter", bars), n, seed, errors, options,
        title="the rail support with its bar", again=f"--bars {bars}",
    )  # fmt: skip
