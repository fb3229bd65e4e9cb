"""The command that makes fast moves in empty space, in many worlds."""

from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import Json, WholeNumber, positive, say
from handeye.cli.sweeps import FirstSeed
from handeye.systems.sigma.cli.studies import put_study


def moves(
    *,
    n: Annotated[
        WholeNumber, Parameter(name="--n", help="Number of worlds. The seed of world K is --seed plus K.")
    ] = 10,
    seed: FirstSeed = 0,
    json: Json = False,
) -> int:
    """Make fast moves in empty space, with and without the wrists' accelerometers, and show forces and false stops.

    Exit code 0: with accelerometers, no reflex stopped a move; 1: with accelerometers, a reflex stopped a move; 2: bad
    input.
    """
    from handeye.systems.sigma.gantries.free_moves import free_moves, lines

    positive(n, "world")
    found = [
        free_moves(each, compensated=compensated)
        for each in range(seed, seed + n)
        for compensated in (True, False)
    ]
    right = not any(each.tripped for each in found if each.compensated)
    if json:
        put_study("moves", {"moves": found}, completed=right, message="; ".join(lines(found)), seed=seed)
    else:
        for line in lines(found):
            say(line, whole=True)
    return 0 if right else 1
