"""The commands of the assembly line: one world, and many."""

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
Pieces = Annotated[WholeNumber, Parameter(help=f"Number of pieces on the feeder, 1 to {USUAL}.")]


def line(
    file: Program = None,
    /,
    *,
    pieces: Pieces = USUAL,
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: JobOptions = ANY_RUN,
) -> int:
    """Run an assembly line: a feeder brings pieces, each of two SUPERSIGMAs presses a pin into every piece, and a
    belt withdraws them.

    `plans/line.mal` runs on four simulated arms, a feeder and a belt in a world drawn from a seed: 26 microcomputers on
    one bus of three segments. A referee then checks that each piece stands at its place on the belt, within 3 mm
    and 3 degrees, with both pins pressed in to within .5 mm; that the program counted the finished pieces
    correctly; and that no arms touched each other.

    Exit code 0: right; 1: the program stopped before its end, for example at a deadlock or because arms collided;
        3: the program ended, but the referee disagrees; 2: bad input; 130: interrupted.
    """
    _check_pieces(pieces)
    plan = job_or_own_plan("line", pieces, file)
    return 2 if plan is None else carry_out(plan, seed, errors, options)


def _check_pieces(pieces: int) -> None:
    if not 1 <= pieces <= USUAL:
        raise BadArgument(f"the feeder must have 1 to {USUAL} pieces, not {pieces}")


def line_trials(
    *,
    n: NumberOfBoards = 10,
    seed: FirstSeed = 0,
    pieces: Pieces = USUAL,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Run the assembly line in many worlds: how often all is right, errors of places, and the load of the bus.

    Each trial does what `handeye sigma line` does. Ctrl-C ends the batch and prints the trials that have finished;
    with --out, the same command continues the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
        the referee disagrees.
    """
    from handeye.systems.sigma.run.job_trials import LINE_TRIALS
    from handeye.systems.sigma.run.jobs import job_plan

    _check_pieces(pieces)
    return carry_out_trials(
        LINE_TRIALS, job_plan("line", pieces), n, seed, errors, options,
        title=f"assembly line with {counted(pieces, 'piece')}", again=f"--pieces {pieces}",
    )  # fmt: skip
