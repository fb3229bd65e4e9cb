"""The commands of the plate of the pump: one world, and many."""

from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions
from handeye.cli.world_options import ANY_OWN_ERRORS, OwnErrorOptions
from handeye.systems.sigma.cli.handover import Program
from handeye.systems.sigma.cli.jobs import (
    ANY_RUN,
    JobOptions,
    JobSeed,
    NumberOfBoards,
    carry_out,
    carry_out_trials,
    job_or_own_plan,
)


def prco(
    file: Program = None,
    /,
    *,
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: JobOptions = ANY_RUN,
) -> int:
    """Assemble the plate of the pump with two arms: arm 1 lays it down and puts in two pins, arm 2 drives six screws.

    `plans/prco.mal` runs on two simulated gantries in a world drawn from a seed. A referee then checks that the
    plate lies on its base, with both pins at the bottom of their holes; that each screw is in its thread, with its
    head at its seat and a clamping force of at least 40 N; that the program counted the pins and screws in place
    correctly; and that the arms never touched each other.

    Exit code 0: right; 1: the program stopped before its end, for example because a screw did not reach its seat;
        3: the program ended, but the referee disagrees; 2: bad input; 130: interrupted.
    """
    from handeye.systems.sigma.prco.drawing import MOST

    plan = job_or_own_plan("prco", MOST, file)
    return 2 if plan is None else carry_out(plan, seed, errors, options)


def prco_trials(
    *,
    n: NumberOfBoards = 10,
    seed: FirstSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Assemble the plate of the pump in many worlds: how often all is right, depth and clamp of screws, and bus load.

    Each trial does what `handeye sigma prco` does. Ctrl-C ends the batch and prints the trials that have finished;
    with --out, the same command continues the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
        the referee disagrees.
    """
    from handeye.systems.sigma.prco.drawing import MOST
    from handeye.systems.sigma.run.job_trials import PRCO_TRIALS
    from handeye.systems.sigma.run.jobs import job_plan

    return carry_out_trials(
        PRCO_TRIALS, job_plan("prco", MOST), n, seed, errors, options,
        title="plate of the pump",
    )  # fmt: skip
