"""The options for the worlds of a batch: --seed and --n, or --seeds."""

import re
from collections import Counter
from collections.abc import Sequence
from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import LONGEST_NUMBER, positive
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument
from handeye.core.variation import checked_seed

Seeds = Annotated[
    str | None,
    Parameter(
        help="Instead of --seed and --n: the seeds of the trials, as numbers and ranges separated by commas, "
        "such as 20261126,0-19."
    ),
]


def seeds_of(n: int | None, seed: int | None, seeds: str | None, *, usual: int) -> Sequence[int]:
    """The seeds of a batch; by default, `usual` seeds. Raises BadArgument if the options are not valid."""
    if seeds is None:
        first, count = seed or 0, usual if n is None else n
        positive(count, "trial")
        return _seeds(first, first + count - 1)
    if n is not None or seed is not None:
        raise BadArgument("--seeds replaces --n and --seed: leave out either --seeds or the other two")
    ranges = [_range(part) for part in seeds.split(",")]
    if len(ranges) == 1:
        return ranges[0]
    positive(sum(map(len, ranges)), "trial")
    found = [each for part in ranges for each in part]
    twice = next((each for each, times in Counter(found).items() if times > 1), None)
    if twice is not None:
        raise BadArgument(f"--seeds names {twice} twice")
    return found


def _range(text: str) -> range:
    """Return the seeds that the text names. Raises BadArgument if the text is neither a number nor a range."""
    found = re.fullmatch(f"([0-9]{{1,{LONGEST_NUMBER}}})(?:-([0-9]{{1,{LONGEST_NUMBER}}}))?", text.strip())
    first, last = (0, -1) if found is None else (int(found[1]), int(found[2] or found[1]))
    if last < first:
        raise BadArgument(
            f"seeds are numbers and ranges such as 20261126,0-19; {quoted(text)} is neither a number nor a range"
        )
    return _seeds(first, last)


def _seeds(first: int, last: int) -> range:
    """The seeds of a range; raises BadArgument if the range is empty or too long."""
    checked_seed(first)
    checked_seed(last)
    positive(last - first + 1, "trial")
    return range(first, last + 1)


def following(seeds: Sequence[int]) -> bool:
    """True if each seed is one more than the previous one."""
    return all(seed == seeds[0] + k for k, seed in enumerate(seeds))
