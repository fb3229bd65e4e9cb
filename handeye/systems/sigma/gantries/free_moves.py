"""Makes fast moves in empty space, measures the forces on the wrists, and counts the moves that a reflex stops."""

from collections.abc import Sequence
from typing import Final

import numpy as np

from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.core.variation import Seed, WorldSpec
from handeye.systems.sigma import protocol
from handeye.systems.sigma.bus.wired import WiredBus
from handeye.systems.sigma.gantries.machine import Gantries, scene
from handeye.systems.sigma.gantries.world import GantryWorld
from handeye.systems.sigma.protocol import AXES, NUMBERS

MOVES: Final = (
    ("X1", 8000), ("Y1", 8000), ("Z1", 3500), ("X1", -267), ("Z1", -13), ("X1", 8), ("X2", 4000), ("Z2", 3000),
)  # fmt: skip
"""The moves, each with its axis and its number of steps: long, medium and short ones."""
_REST: Final = 100_000  # microseconds between two moves, until the wrists are still
_LONGEST: Final = 10_000_000  # microseconds: longest duration of a move


class FreeMoves(Record, frozen=True, kw_only=True):
    """Fast moves in one world."""

    seed: Seed
    compensated: bool  # True: the accelerometers are on
    force: float  # N: greatest force on any wrist
    tripped: int  # moves that a reflex stopped
    moves: int = len(MOVES)


def free_moves(seed: int, *, compensated: bool) -> FreeMoves:
    """Make the moves in the world of a seed."""
    world = GantryWorld(WorldSpec(seed=seed))
    gantries = Gantries(scene(world), world, compensated=compensated)
    bus = WiredBus(plant=gantries, seed=seed, clock_spread=world.clock_spread)
    greatest, tripped = np.zeros(len(AXES)), 0

    def look() -> None:
        np.maximum(greatest, np.abs(gantries.felt), out=greatest)

    gantries.bench.after_step.append(look)
    for axis, steps in MOVES:
        end = bus.now + _REST
        while bus.now < end:
            bus.wait(end)
        bus.send(protocol.move(axis, steps))
        if bus.wait_free(NUMBERS[axis], _LONGEST).aborted:
            tripped += 1
            bus.ask(protocol.position(axis), 2)  # this question clears line A
    return FreeMoves(
        seed=seed, compensated=compensated, force=round(float(greatest.max()), 2), tripped=tripped
    )


def lines(found: Sequence[FreeMoves]) -> list[str]:
    """Return sentences that describe the moves in all worlds."""
    out = []
    for compensated in (True, False):
        these = [each for each in found if each.compensated is compensated]
        forces = [f"{force:.1f}" for force in sorted(each.force for each in these)]
        span = forces[0] if forces[0] == forces[-1] else f"{forces[0]} to {forces[-1]}"
        moves, tripped = sum(each.moves for each in these), sum(each.tripped for each in these)
        worlds = counted(len(these), "world")
        out.append(
            f"{'with' if compensated else 'without'} accelerometers: the reflex stopped {tripped} of {moves} moves "
            f"in {worlds}; the greatest force in each world was {span} N"
        )
    return out
