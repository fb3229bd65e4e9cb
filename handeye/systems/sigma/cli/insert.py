"""The commands of the insertion: one board, and many."""

from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import WholeNumber
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions
from handeye.cli.world_options import ANY_OWN_ERRORS, OwnErrorOptions
from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted
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

USUAL = 4
Pegs = Annotated[
    WholeNumber, Parameter(help=f"Number of pegs, 1 to {USUAL}; the arms take turns at the rack.")
]


def insert(
    file: Program = None,
    /,
    *,
    pegs: Pegs = USUAL,
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: JobOptions = ANY_RUN,
) -> int:
    """Straighten pegs in a rack, and find the holes for them by force, with both arms.

    `plans/insert.mal` runs on two simulated gantries in a world drawn from a seed. Pegs stand turned by up to 20
    degrees, and plates lie up to 3 mm beside their places. A referee then checks that each peg stands in its hole,
    no plate moved by more than 1 mm, no wrist felt more than 25 N, no motor lost a step, the program counted the
    inserted pegs correctly, and the arms never touched each other.

    Exit code 0: right; 1: the program stopped before its end; 3: the program ended, but the referee disagrees; 2:
    bad input; 130: interrupted.
    """
    _check_pegs(pegs)
    plan = job_or_own_plan("insert", pegs, file)
    return 2 if plan is None else carry_out(plan, seed, errors, options)


def _check_pegs(pegs: int) -> None:
    if not 1 <= pegs <= USUAL:
        raise BadArgument(f"an insertion must have 1 to {USUAL} pegs, not {pegs}")


def insert_trials(
    *,
    n: NumberOfBoards = 10,
    seed: FirstSeed = 0,
    pegs: Pegs = USUAL,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Insert the pegs of many boards: how often all is right, forces, and the load of the bus.

    Each trial does what `handeye sigma insert` does. Ctrl-C ends the batch and prints the trials that have
    finished; with --out, the same command continues the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
        the referee disagrees.
    """
    from handeye.systems.sigma.run.job_trials import INSERTION_TRIALS
    from handeye.systems.sigma.run.jobs import job_plan

    _check_pegs(pegs)
    return carry_out_trials(
        INSERTION_TRIALS, job_plan("insert", pegs), n, seed, errors, options,
        title=f"insertion of {counted(pegs, 'peg')}", again=f"--pegs {pegs}",
    )  # fmt: skip
