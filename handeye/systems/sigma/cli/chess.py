"""The commands of the chess experiment, for one board and for many boards."""

from typing import Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import WholeNumber
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions
from handeye.cli.world_options import ANY_OWN_ERRORS, OwnErrorOptions
from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted
from handeye.systems.sigma.cli.jobs import (
    ANY_RUN,
    JobOptions,
    JobSeed,
    NumberOfBoards,
    carry_out,
    carry_out_trials,
)
from handeye.systems.sigma.run.plan import MOST_PIECES

USUAL: Final = 8
Pieces = Annotated[WholeNumber, Parameter(help=f"Number of pieces on the board, 1 to {MOST_PIECES}.")]


def chess(
    *,
    pieces: Pieces = USUAL,
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: JobOptions = ANY_RUN,
) -> int:
    """Find chess pieces along three lines, measure their heights with a light beam, and sort them: the paper's example.

    `plans/chess.mal` runs on two simulated gantries in a world drawn from a seed. A referee then checks that each
    piece stands on the line for its height, within 5 mm and 3 degrees, and that each measured height is right
    within .6 mm.

    Exit code 0: right; 1: the program stopped before its end; 3: the program ended, but the referee disagrees; 2:
    bad input; 130: interrupted.
    """
    from handeye.systems.sigma.run.jobs import job_plan

    _check_pieces(pieces)
    return carry_out(job_plan("chess", pieces), seed, errors, options)


def _check_pieces(pieces: int) -> None:
    if not 1 <= pieces <= MOST_PIECES:
        raise BadArgument(f"a board must have 1 to {MOST_PIECES} pieces, not {pieces}")


def chess_trials(
    *,
    n: NumberOfBoards = 10,
    seed: FirstSeed = 0,
    pieces: Pieces = USUAL,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Sort the pieces of many boards: how often all are right, errors of heights and places, and the load of the bus.

    Each trial does what `handeye sigma chess` does. Ctrl-C ends the batch and prints the trials that have finished;
    with --out, the same command continues the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
        the referee disagrees.
    """
    from handeye.systems.sigma.run.job_trials import CHESS_TRIALS
    from handeye.systems.sigma.run.jobs import job_plan

    _check_pieces(pieces)
    return carry_out_trials(
        CHESS_TRIALS, job_plan("chess", pieces), n, seed, errors, options,
        title=f"chess with {counted(pieces, 'piece')}", again=f"--pieces {pieces}",
    )  # fmt: skip
