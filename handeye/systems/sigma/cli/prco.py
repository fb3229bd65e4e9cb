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

    `plans/prco.mal` runs on two simulated gantries in a world drawn from a seed. A referee then looks: the plate has
    to lie on its base, with both pins at the bottom of their holes and each screw in its thread, its head at its seat
    and clamped with at least 40 N; the program has to have counted the pins and screws that are right; and the arms
    must not have touched each other.

    Exit code 0: right; 1: the program has stopped before its end, for example because a screw did not reach its seat;
    3: it has ended, and the referee disagrees; 2: bad input; 130: interrupted.
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

    Each trial is that of `handeye sigma prco`. Ctrl-C ends the batch and prints what has finished; with --out it can
    be continued.

    Exit code 0: no silent failure; 1: no trial finished; 3: in some trial the program has ended, and the referee
    disagrees.
    """
    from handeye.systems.sigma.prco.drawing import MOST
    from handeye.systems.sigma.run.job_trials import PRCO_TRIALS
    from handeye.systems.sigma.run.jobs import job_plan

    return carry_out_trials(
        PRCO_TRIALS, job_plan("prco", MOST), n, seed, errors, options,
        title="plate of the pump",
    )  # fmt: skip
