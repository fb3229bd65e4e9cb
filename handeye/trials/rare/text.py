"""Shows on a terminal what a search for rare failures found."""

from collections.abc import Iterator, Sequence
from typing import Final

from handeye.core.plain_text import counted
from handeye.trials.rare.campaign import Estimated
from handeye.trials.rare.nearest import NearWorld, Push
from handeye.trials.text import PlainTable

SHOWN: Final = 4  # quantities of a world that are named
PUSHES: Final = 15  # quantities in the table of pushes
_ENDS: Final = {"stopped": "stops", "silent": "fails silently"}

LEVEL_HEADS: Final = ("level", "runs", "margin at most", "share", "accepted", "failed")
WORLD_HEADS: Final = ("distance", "found at", "needs")
PUSH_HEADS: Final = ("in worlds", "mean there", "mean in all failing worlds")


def levels_table(found: Estimated) -> PlainTable:
    """Return the table of the levels of a search."""
    table = PlainTable(("limited most often by",), *LEVEL_HEADS)
    for part, *figures in level_cells(found):
        table.row(part, *figures)
    return table


def level_cells(found: Estimated) -> Iterator[tuple[str, ...]]:
    """Yield the rows of the table of levels. The first cell of a row names the part of the pump that limits the runs
    of the level; the other cells hold the figures of the level.
    """
    for level, limiting in zip(found.levels, found.limiting, strict=True):
        part = f"{limiting.part} ({100 * limiting.share:.0f} %)" if limiting.part else "nothing"
        yield (
            part, str(level.number), str(level.runs), f"{level.threshold:.3g}", f"{level.share:.3g}",
            "" if level.acceptance is None else f"{level.acceptance:.2f}", str(level.failed),
        )  # fmt: skip


def sentence(found: Estimated) -> str:
    """Say what was estimated, and how sure the estimate is."""
    guess = found.estimate
    figures = (
        f"{guess.probability:.2g} (coefficient of variation {guess.variation:.2f}, {guess.low:.2g} to "
        f"{guess.high:.2g}), after {counted(found.runs, 'run')}"
    )
    if found.reached:
        return f"{found.failure}: estimated probability {figures}; an estimate, not a bound"
    last = found.levels[-1]
    why = "all runs of the last level have the same margin" if last.stuck else "no level is left"
    return (
        f"{found.failure}: no estimate, because {why}. Estimated probability that the margin is at most "
        f"{found.threshold:.3g}: {figures}"
    )


def worlds_table(found: Sequence[NearWorld]) -> PlainTable:
    """Return the table of the failing worlds whose errors are smallest."""
    table = PlainTable(("needs", "why it fails"), *WORLD_HEADS[:2])
    for each in found:
        table.row(needs(each), each.detail, f"{each.distance:.2f}", f"{each.found_at:.2f}")
    return table


def needs(world: NearWorld) -> str:
    """Name the greatest deviations of a world."""
    named = [f"{name} {away:+.2f}" for name, away in [*world.quantities.items()][:SHOWN]]
    more = len(world.quantities) - SHOWN
    if not named:
        return "no deviation: only its noise"
    return ", ".join([*named, *([f"and {more} more"] if more > 0 else [])])


def pushes_table(found: Sequence[Push]) -> PlainTable:
    """Return the table of the quantities that make the program fail."""
    table = PlainTable(("quantity",), *PUSH_HEADS)
    for each in found[:PUSHES]:
        mean = "" if each.mean is None else f"{each.mean:+.2f}"
        table.row(each.quantity, str(each.worlds), mean, f"{each.shift:+.2f}")
    return table


def no_worlds(failure: str) -> str:
    """Say that the search found no world with this kind of failure."""
    return f"{failure}: no world was found in which the program {_ENDS[failure]}"
