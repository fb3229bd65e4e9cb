"""The command that palletises in many worlds and counts."""

from typing import TYPE_CHECKING, Annotated

from cyclopts import Parameter

from handeye.cli.common import Json, WholeNumber, positive, put_json, say
from handeye.cli.tally import Tally
from handeye.core.errors import BadArgument
from handeye.core.plain_text import counted as words
from handeye.core.variation import checked_seed

if TYPE_CHECKING:
    from handeye.systems.trig.run.job import JobReport
    from handeye.systems.trig.run.pallet_trials import PalletFigures


def pallet_trials(
    *,
    n: Annotated[
        WholeNumber, Parameter(name="--n", help="Trials; number k is in the world of --seed + k.")
    ] = 10,
    seed: Annotated[WholeNumber, Parameter(help="The first world.")] = 0,
    blocks: Annotated[WholeNumber, Parameter(help="In the stack, 0 to 20.")] = 7,
    interrupt: Annotated[
        bool, Parameter(help="Break each run off after a drawn number of steps, and undo it from there.")
    ] = False,
    workers: Annotated[WholeNumber, Parameter(help="Processes at a time.")] = 1,
    json: Json = False,
) -> int:
    """Palletise in many worlds, and take everything back: how often it comes out right, and how far off blocks are.

    Each trial is that of `handeye trig palletise`: taught, run, judged, undone, judged. Ctrl-C ends the batch, and what
    has ended is told.

    Exit code 0: no silent failure; 3: in some trial all was said to be done, and the referee disagrees.
    """
    from handeye.systems.trig.jobs.benches import MOST_BLOCKS
    from handeye.systems.trig.run.pallet_trials import figures, trials

    for count, what in ((n, "trial"), (workers, "process")):
        positive(count, what)
    if not 0 <= blocks <= MOST_BLOCKS:
        raise BadArgument(f"a stack of 0 to {MOST_BLOCKS} blocks can be palletised, not of {blocks}")
    found: list[JobReport] = []
    try:
        ended = trials(n, seed=checked_seed(seed), blocks=blocks, interrupt=interrupt, workers=workers)
        for trial in Tally(n, "trials").counting(ended):
            found.append(trial)
    finally:  # what has ended when it is broken off, too
        if found:
            counted = figures(found, blocks, interrupt=interrupt)
            put_json(counted) if json else _tell(counted)
    return 3 if counted.silent_failures else 0


def _tell(counted: "PalletFigures") -> None:
    low, high = counted.wilson95 or (0.0, 1.0)
    trials, blocks = words(counted.n, "trial"), words(counted.blocks, "block")
    say(f"{trials} with {blocks}: {counted.right} right ({low:.1%} to {high:.1%})")
    say(
        f"{counted.stopped} stopped, {counted.silent_failures} silent; {counted.arm_s:.0f} s of the arm's clock"
    )
    say(
        "largest of each finding: " + ", ".join(f"{name} {value:.3g}" for name, value in counted.most.items())
    )
    for failure in counted.failures:
        say(f"{failure.outcome}: {failure.told}\n  {failure.command}", whole=True)
