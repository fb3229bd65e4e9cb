"""Measures how costs grow with the length of a program and with the number of cells in one process."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from math import fsum, log
from statistics import fmean
from typing import Final, Literal

from benchmarks.growth_costs import Costs, Unit, cells, statements
from handeye.core.plain_text import counted

LINEAR: Final = 1.15
"""Growth with a power up to this counts as linear. It is more than 1, because data that no longer fit into the
processor's caches cost more.
"""
MOST_CELLS: Final = 3
_DECADES: Final = 2
"""Growth is fitted over this many powers of ten below the largest size. Smaller sizes mainly cost what is done once."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Growth:
    """One cost, measured at several sizes."""

    what: str
    of: Literal["statements", "cells"]
    """What the sizes count."""
    unit: Unit
    sizes: tuple[int, ...]
    values: tuple[float, ...]

    @property
    def power(self) -> float:
        """The power of the size with which the cost grows: the slope of a line through the logarithms, at the larger
        sizes.
        """
        least = self.sizes[-1] / 10**_DECADES
        return _slope(
            [
                (log(size), log(value))
                for size, value in zip(self.sizes, self.values, strict=True)
                if size >= least and value > 0
            ]
        )

    @property
    def is_linear(self) -> bool:
        """True if ten times the size costs about ten times as much, or less."""
        return self.power <= LINEAR

    def as_json(self) -> dict[str, object]:
        """Return the measurements for JSON. The key of the values is their unit."""
        return {
            "what": self.what,
            "of": self.of,
            "sizes": self.sizes,
            self.unit: self.values,
            "power": self.power,
            "linear": self.is_linear,
        }


def measure(most: int, told: Callable[[str], None] = lambda _: None) -> Iterator[Growth]:
    """Measure all costs.

    Args:
        most: the largest number of statements; the smaller ones are the powers of ten below it.
        told: called with the name of what is measured next.
    """
    numbers = range(1, MOST_CELLS + 1)
    cells(1)  # makes everything that is made once for all cells
    yield from _grown("cells", numbers, [_told(told, number, "cell", cells) for number in numbers])
    sizes = sorted({10**power for power in range(len(str(most)))} | {most})
    statements(1)
    yield from _grown("statements", sizes, [_told(told, size, "statement", statements) for size in sizes])


def _told(told: Callable[[str], None], number: int, what: str, cost: Callable[[int], Costs]) -> Costs:
    told(counted(number, what))
    return cost(number)


def _grown(
    of: Literal["statements", "cells"], sizes: Sequence[int], costs: Sequence[Costs]
) -> Iterator[Growth]:
    for what, unit in costs[0]:
        values = tuple(each[what, unit] for each in costs)
        yield Growth(what=what, of=of, unit=unit, sizes=tuple(sizes), values=values)


def _slope(points: Sequence[tuple[float, float]]) -> float:
    """Return the slope of the least-squares line through some points; 0 if there are fewer than two."""
    if len(points) < 2:
        return 0.0
    x_mean, y_mean = (fmean(values) for values in zip(*points, strict=True))
    spread = fsum((x - x_mean) ** 2 for x, _ in points)
    return fsum((x - x_mean) * (y - y_mean) for x, y in points) / spread
