"""The commands of the chess experiment, for one board and for many boards."""

import shlex
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import (
    Details,
    Json,
    NoKeep,
    Out,
    Overwrite,
    WholeNumber,
    complain,
    note,
    positive,
    say,
)
from handeye.cli.runs import Break, Live, OnStop, Step, check_kept
from handeye.cli.sweeps import ANY, FirstSeed, SweepOptions, carry_out_sweep
from handeye.cli.videos import drawing
from handeye.cli.world_options import ANY_OWN_ERRORS, OwnErrorOptions
from handeye.core.errors import BadArgument, CannotWrite, InvalidInput
from handeye.core.plain_text import counted
from handeye.systems.sigma.run.plan import MOST_PIECES

USUAL: Final = 8
Pieces = Annotated[WholeNumber, Parameter(help=f"Number of pieces on the board, 1 to {MOST_PIECES}.")]


def chess(
    *,
    pieces: Pieces = USUAL,
    seed: Annotated[
        WholeNumber, Parameter(help="Seed of the world: it decides the pieces and the errors of the machine.")
    ] = 0,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    json: Json = False,
    details: Details = False,
    out: Out = None,
    video: Annotated[
        Path | None, Parameter(help="Video of the run, .webp, .webm or .mp4, 14 s long.")
    ] = None,
    overwrite: Overwrite = False,
    no_keep: NoKeep = False,
    breaks: Break = None,
    step: Step = False,
    live: Live = False,
    on_stop: OnStop = None,
) -> int:
    """Find chess pieces along three lines, measure their heights with a light beam, and sort them: the paper's example.

    `plans/chess.mal` runs on two simulated gantries in a world drawn from a seed. A referee then looks: each piece has
    to stand on the line of its height, within 5 mm and 3 degrees, and each measured height has to be right within
    .6 mm.

    Exit code 0: right; 1: the program has stopped before its end; 3: it has ended, and the referee disagrees; 2: bad
    input; 130: interrupted.
    """
    from handeye.cli.job import Job, work
    from handeye.runs.snapshot import Checkpoint
    from handeye.systems.sigma.cli.commands import Printer
    from handeye.systems.sigma.run.chess_plan import chess_setup

    check_kept(no_keep, out)
    _check_pieces(pieces)
    setup = chess_setup(pieces, errors.of("chess").spec(seed))
    with TemporaryDirectory() as aside:
        folder = out
        if video is not None:
            _check_video(video, out, overwrite=overwrite)
            folder = out or Path(aside) / "run"
        printers = () if step else (Printer(note if json else say),)
        code = work(
            Job(
                start=Checkpoint(setup=setup), out=folder, keep=not (no_keep or step), details=details,
                overwrite=overwrite, breaks=breaks or (), step=step, live=live, on_stop=on_stop, json=json,
                referee=True, listening=printers,
            )
        )  # fmt: skip
        if video is None or folder is None or code not in (0, 1, 3):
            return code
        return code or (0 if _filmed(folder, video, overwrite=overwrite) else 2)


def _check_pieces(pieces: int) -> None:
    if not 1 <= pieces <= MOST_PIECES:
        raise BadArgument(f"a board has 1 to {MOST_PIECES} pieces, not {pieces}")


def _check_video(video: Path, out: Path | None, *, overwrite: bool) -> None:
    """Raise InvalidInput before the run if the video could not be written after it."""
    from handeye.cell.opengl import context
    from handeye.core.files import check_place
    from handeye.video.formats import format_of

    check_place(video, format_of(video).kind, overwrite=overwrite)
    context()
    if out is not None and video.absolute().is_relative_to(out.absolute()):
        raise CannotWrite(f"{video} is in the folder of --out, which belongs to a run; choose another place")


def _filmed(folder: Path, video: Path, *, overwrite: bool) -> bool:
    """Make the video from the trace of the run. If that fails, report the error and return False."""
    from handeye.runs.folder import TRACE
    from handeye.trace.reading import read_trace
    from handeye.video.making import make_video
    from handeye.video.request import VideoRequest

    try:
        with drawing() as told:
            make_video(read_trace(folder / TRACE), video, VideoRequest(), overwrite=overwrite, told=told)
    except InvalidInput as error:
        complain(error)
        return False
    return True


def chess_trials(
    *,
    n: Annotated[
        WholeNumber, Parameter(name="--n", help="Number of boards; board K has the seed --seed plus K.")
    ] = 10,
    seed: FirstSeed = 0,
    pieces: Pieces = USUAL,
    errors: OwnErrorOptions = ANY_OWN_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Sort the pieces of many boards: how often all are right, errors of heights and places, and the load of the bus.

    Each trial is that of `handeye sigma chess`. Ctrl-C ends the batch and prints what has finished; with --out it can
    be continued.

    Exit code 0: no silent failure; 1: no trial finished; 3: in some trial the program has ended, and the referee
    disagrees.
    """
    from handeye.systems.sigma.run.chess_trials import CHESS_TRIALS, ChessWork
    from handeye.trials.folder import head_of
    from handeye.trials.sweep import cases

    positive(n, "trial")
    options.check()
    _check_pieces(pieces)
    world = errors.of("chess").spec(seed)
    words = shlex.join(errors.words())
    more = f"{' ' + words if words else ''}"
    return carry_out_sweep(
        CHESS_TRIALS,
        ChessWork(pieces=pieces, world=world),
        cases(seed, range(n)),
        head_of(CHESS_TRIALS, world, settings={"pieces": str(pieces)}),
        options,
        title=f"chess with {counted(pieces, 'piece')}, on boards from seed {seed} on",
        again=lambda row: f"handeye trials chess --n 1 --seed {row.seed} --pieces {pieces}{more}",
        more={"pieces": pieces},
    )
