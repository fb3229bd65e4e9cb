"""The commands of all jobs on the board. Each job has a command for one world and a command for many worlds."""

from functools import partial
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import WholeNumber, note, say
from handeye.cli.judged_jobs import ANY_FAULTY_RUN, FaultyJobOptions, carry_out_job, carry_out_job_trials
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions
from handeye.cli.world_options import ANY_OWN_ERRORS, OwnErrorOptions, broken
from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted
from handeye.systems.sigma.run.plan import MOST_PIECES
from handeye.tasks import any_task

if TYPE_CHECKING:
    from handeye.systems.sigma.run.plan import JobName, MalPlan

USUAL: Final = 8  # chess pieces
MOST_PEGS: Final = 4
MOST_FED: Final = 4

Program = Annotated[
    Path | None,
    Parameter(help="A MAL program (`.mal`) to run on the same board, in place of handeye's own program."),
]
JobSeed = Annotated[
    WholeNumber, Parameter(help="Seed of the world: it determines the pieces and the errors of the machine.")
]
NumberOfBoards = Annotated[
    WholeNumber, Parameter(name="--n", help="Number of boards. The seed of board K is --seed plus K.")
]
Pieces = Annotated[WholeNumber, Parameter(help=f"Number of pieces on the board, 1 to {MOST_PIECES}.")]
Pegs = Annotated[
    WholeNumber, Parameter(help=f"Number of pegs, 1 to {MOST_PEGS}; the arms take turns at the rack.")
]
Fed = Annotated[WholeNumber, Parameter(help=f"Number of pieces on the feeder, 1 to {MOST_FED}.")]


def chess(
    *,
    pieces: Pieces = USUAL,
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: FaultyJobOptions = ANY_FAULTY_RUN,
) -> int:
    """Find chess pieces along three lines, measure their heights with a light beam, and sort them, as in the paper.

    `plans/chess.mal` runs on two simulated gantries, in a world with errors. A referee then checks that each piece
    stands on the line for pieces of its height, within 5 mm and 3 degrees, and that each measured height is right
    within .6 mm.

    Exit code 0: right; 1: the program stopped before its end; 3: the program ended, but the referee disagrees; 2:
    bad input; 130: interrupted.
    """
    _check("a board", pieces, MOST_PIECES, "pieces")
    return _carry_out("chess", pieces, None, seed, errors, options)


def handover(
    file: Program = None,
    /,
    *,
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: FaultyJobOptions = ANY_FAULTY_RUN,
) -> int:
    """Hand four pieces from arm to arm: arm 1 brings the pieces; arm 2 presses in their pins and takes the pieces away.

    `plans/handover_pieces.mal` runs on two simulated gantries, in a world with errors. A referee then checks that each
    piece stands at its final place, within 3 mm and 3 degrees, with its pin protruding by at most .5 mm. The program
    must have counted the finished pieces correctly, and the arms must never have touched each other.

    Exit code 0: right; 1: the program stopped before its end, for example at a deadlock or because the arms
        collided; 3: the program ended, but the referee disagrees; 2: bad input; 130: interrupted.
    """
    return _carry_out("handover", None, file, seed, errors, options)


def insert(
    file: Program = None,
    /,
    *,
    pegs: Pegs = MOST_PEGS,
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: FaultyJobOptions = ANY_FAULTY_RUN,
) -> int:
    """With both arms, straighten pegs in a rack, and find the holes for the pegs by force.

    `plans/insert.mal` runs on two simulated gantries, in a world with errors. Each peg is rotated by up to 20 degrees,
    and plates lie up to 3 mm from their places. A referee then checks that each peg stands in its hole, and that no
    plate moved by more than 1 mm. No wrist may have felt more than 25 N, no motor may have lost a step, and the arms
    must never have touched each other. The program must have counted the inserted pegs correctly.

    Exit code 0: right; 1: the program stopped before its end; 3: the program ended, but the referee disagrees; 2:
    bad input; 130: interrupted.
    """
    _check("an insertion", pegs, MOST_PEGS, "pegs")
    return _carry_out("insert", pegs, file, seed, errors, options)


def line(
    file: Program = None,
    /,
    *,
    pieces: Fed = MOST_FED,
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: FaultyJobOptions = ANY_FAULTY_RUN,
) -> int:
    """Run an assembly line: a feeder brings pieces, each of two SUPERSIGMAs presses a pin into every piece, and a belt
    takes the pieces away.

    `plans/line.mal` runs on four simulated arms, a feeder and a belt, in a world with errors. The machine has 26
    microcomputers on one bus of three segments. A referee then checks that each piece stands at its place on the belt,
    within 3 mm and 3 degrees, with both pins protruding by at most .5 mm. The program must have counted the finished
    pieces correctly, and the arms must never have touched each other.

    Exit code 0: right; 1: the program stopped before its end, for example at a deadlock or because arms collided;
        3: the program ended, but the referee disagrees; 2: bad input; 130: interrupted.
    """
    _check("the feeder", pieces, MOST_FED, "pieces")
    return _carry_out("line", pieces, file, seed, errors, options)


def prco(
    file: Program = None,
    /,
    *,
    seed: JobSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: FaultyJobOptions = ANY_FAULTY_RUN,
) -> int:
    """Assemble the plate of the pump with two arms: arm 1 lays the plate down and puts in two pins; arm 2 drives six
    screws.

    `plans/prco.mal` runs on two simulated gantries, in a world with errors. A referee then checks that the plate lies
    on its base, with both pins at the bottom of their holes. Each screw must be in its thread, with its head at its
    seat and a clamping force of at least 40 N. The program must have counted the pins and screws in place correctly,
    and the arms must never have touched each other.

    Exit code 0: right; 1: the program stopped before its end, for example because a screw did not reach its seat;
        3: the program ended, but the referee disagrees; 2: bad input; 130: interrupted.
    """
    return _carry_out("prco", None, file, seed, errors, options)


def chess_trials(
    *,
    n: NumberOfBoards = 10,
    seed: FirstSeed = 0,
    pieces: Pieces = USUAL,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Sort the pieces of many boards. Shows the bus load, the errors of the heights and positions of the pieces, and
    how often all pieces are right.

    Each trial does what `handeye sigma chess` does. Ctrl-C ends the batch and prints the trials that have finished. If
    you gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
        the referee disagrees.
    """
    _check("a board", pieces, MOST_PIECES, "pieces")
    return _try_out(
        "chess", pieces, n, seed, errors, options, f"chess with {counted(pieces, 'piece')}", f"--pieces {pieces}"
    )  # fmt: skip


def handover_trials(
    *,
    n: NumberOfBoards = 10,
    seed: FirstSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Hand four pieces from arm to arm on many boards. Shows the bus load, the position errors of the pieces, and
    how often all pieces are right.

    Each trial does what `handeye sigma handover` does. Ctrl-C ends the batch and prints the trials that have finished.
    If you gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
        the referee disagrees.
    """
    return _try_out("handover", None, n, seed, errors, options, "hand-over of four pieces")


def insert_trials(
    *,
    n: NumberOfBoards = 10,
    seed: FirstSeed = 0,
    pegs: Pegs = MOST_PEGS,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Insert the pegs of many boards. Shows the bus load, the forces, and how often all pegs are right.

    Each trial does what `handeye sigma insert` does. Ctrl-C ends the batch and prints the trials that have finished.
    If you gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
        the referee disagrees.
    """
    _check("an insertion", pegs, MOST_PEGS, "pegs")
    return _try_out(
        "insert", pegs, n, seed, errors, options, f"insertion of {counted(pegs, 'peg')}", f"--pegs {pegs}"
    )  # fmt: skip


def line_trials(
    *,
    n: NumberOfBoards = 10,
    seed: FirstSeed = 0,
    pieces: Fed = MOST_FED,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Run the assembly line in many worlds. Shows the bus load, the position errors of the pieces, and how often all
    pieces are right.

    Each trial does what `handeye sigma line` does. Ctrl-C ends the batch and prints the trials that have finished. If
    you gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
        the referee disagrees.
    """
    _check("the feeder", pieces, MOST_FED, "pieces")
    title = f"assembly line with {counted(pieces, 'piece')}"
    return _try_out("line", pieces, n, seed, errors, options, title, f"--pieces {pieces}")


def prco_trials(
    *,
    n: NumberOfBoards = 10,
    seed: FirstSeed = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Assemble the plate of the pump in many worlds. Shows the bus load, how deep and how tight the screws are, and
    how often all parts are right.

    Each trial does what `handeye sigma prco` does. Ctrl-C ends the batch and prints the trials that have finished. If
    you gave --out, repeat the command to continue the batch.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program ended but
        the referee disagrees.
    """
    return _try_out("prco", None, n, seed, errors, options, "plate of the pump")


def _check(subject: str, count: int, most: int, noun: str) -> None:
    if not 1 <= count <= most:
        raise BadArgument(f"{subject} must have 1 to {most} {noun}, not {count}")


def _plan(job: "JobName", pieces: int | None, file: Path | None) -> "MalPlan | None":
    """Return the plan of a job. It has the job's own program or, if `file` is given, the program in that file. Prints
    the mistakes of a program from a file, and returns None if this program has errors.
    """
    from handeye.core.source import read_source
    from handeye.systems.sigma.cli.commands import reported
    from handeye.systems.sigma.run.jobs import job_plan, job_task
    from handeye.systems.sigma.run.plan import MalPlan, sound

    pieces = job_task(job).usual if pieces is None else pieces
    if file is None:
        return job_plan(job, pieces)
    source = read_source(file)
    if not reported(source):
        return None
    plan = MalPlan(name=file.name, text=source.text, arm="gantries", job=job, pieces=pieces)
    sound(plan)
    return plan


def _carry_out(
    job: "JobName", pieces: int | None, file: Path | None, seed: int, errors: OwnErrorOptions, options: FaultyJobOptions
) -> int:  # fmt: skip
    """Run a job, let its referee judge the result, and make the video. Returns the exit code."""
    from handeye.systems.sigma.cli.commands import Printer
    from handeye.systems.sigma.run.jobs import job_setup

    plan = _plan(job, pieces, file)
    if plan is None:
        return 2
    world = broken(errors.of(job).spec(seed), options.fault, any_task(job))
    return carry_out_job(job_setup(plan, world), options, (Printer(note if options.json else say),))


def _try_out(
    job: "JobName", pieces: int | None, n: int, seed: int, errors: OwnErrorOptions, options: SweepOptions, title: str,
    again: str = "",
) -> int:  # fmt: skip
    """Run a job on many boards, and return the exit code."""
    from handeye.systems.sigma.run.job_trials import TRIALS
    from handeye.systems.sigma.run.jobs import job_setup

    plan = _plan(job, pieces, None)
    assert plan is not None
    return carry_out_job_trials(
        TRIALS[job], partial(job_setup, plan), n, seed, errors, options, settings={"pieces": plan.pieces},
        title=f"{title}, on boards with seeds from {seed} upwards", again=again,
    )  # fmt: skip
