"""The figures of a batch as lines for a terminal."""

from collections.abc import Iterator
from typing import TYPE_CHECKING

if TYPE_CHECKING:
    from handeye.trials.batch.figures import Failure, Figures


def lines(found: "Figures") -> Iterator[str]:
    """All that is told of a batch, its failures with the commands that carry them out again."""
    for failure in found.failures:
        yield from _failure(failure)
    yield verdict(found)


def verdict(found: "Figures") -> str:
    """How many trials were assembled, and how sure that is."""
    counts = [
        f"{found.silent_failures} silent failures",
        f"{found.stopped} stopped",
        f"{found.failed} broken off",
    ]
    text = f"{found.assembled} of {found.n} assembled, {', '.join(counts)}"
    if found.wilson95 is None or found.p_s is None:
        return text
    return f"{text}\nassembled: {percent(*found.wilson95)} (Wilson, 95 %), at least {percent(found.p_s)} (exact, 95 %)"


def percent(*parts: float) -> str:
    """Parts of one as percentages: `88.6 to 99.1 %`."""
    return f"{' to '.join(f'{100 * part:.1f}' for part in parts)} %"


def _failure(failure: "Failure") -> Iterator[str]:
    stage = f"“{failure.stage}”" if failure.stage not in ("", "referee") else failure.stage
    place = f"{stage}, line {failure.line}" if failure.line else stage
    yield f"trial {failure.trial}, seed {failure.seed}: {failure.verdict}, {place}: {failure.detail}"
    yield f"  {failure.command}"
