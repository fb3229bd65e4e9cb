"""The command for palletising trials."""

import shlex
from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import WholeNumber, positive
from handeye.cli.sweeps import ANY, SweepOptions, carry_out_sweep
from handeye.cli.world_options import ANY_ERRORS, ErrorOptions
from handeye.core.errors import BadArgument


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
    errors: ErrorOptions = ANY_ERRORS,
    options: SweepOptions = ANY,
) -> int:
    """Palletise in many worlds, and take everything back: how often it comes out right, and how far off blocks are.

    Each trial is that of `handeye trig palletise`: taught, run, judged, undone, judged. Ctrl-C ends the batch, and what
    has ended is told.

    Exit code 0: no silent failure; 1: every trial broke off; 3: in some trial all was said to be done, and the referee
    disagrees.
    """
    from handeye.systems.trig.jobs.benches import MOST_BLOCKS
    from handeye.systems.trig.run.pallet_trials import PALLET, PalletWork
    from handeye.trials.folder import head_of
    from handeye.trials.sweep import cases

    positive(n, "trial")
    options.check()
    if not 0 <= blocks <= MOST_BLOCKS:
        raise BadArgument(f"a stack of 0 to {MOST_BLOCKS} blocks can be palletised, not of {blocks}")
    settings = {"blocks": str(blocks), "whether runs are broken off": "yes" if interrupt else "no"}
    world = errors.of("palletise").spec(seed)
    words = shlex.join(errors.words())
    broken = f"{' --interrupt' if interrupt else ''}{' ' + words if words else ''}"
    return carry_out_sweep(
        PALLET,
        PalletWork(blocks=blocks, interrupt=interrupt, world=world),
        cases(seed, range(n)),
        head_of(PALLET, world, settings=settings),
        options,
        title=f"the palletiser with {blocks} blocks, in worlds from seed {seed} on",
        again=lambda row: f"handeye trials pallet --n 1 --seed {row.seed} --blocks {blocks}{broken}",
        more={"blocks": blocks, "interrupted": interrupt},
    )
