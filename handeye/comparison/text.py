"""The comparison of two runs as text, in the arm language's units."""

from collections.abc import Callable, Iterator, Sequence
from typing import Any, Final

from handeye.comparison.comparison import Comparison, Condition
from handeye.comparison.findings import Corrections, Searches, Stops
from handeye.comparison.first import First
from handeye.comparison.parting import Divergence
from handeye.comparison.wording import (
    THINNED,
    correction_words,
    first_words,
    moment_words,
    place_words,
    run_words,
    same_words,
    search_words,
    stop_words,
    turning_words,
)
from handeye.core.units import INCH, Measures
from handeye.trace.account import ASTRAY

_BOTH: Final = ("A", "B")


def comparison_text(found: Comparison) -> list[str]:
    """A comparison as lines of text."""
    runs = [f"{letter}  {run_words(run)}" for letter, run in zip(_BOTH, (found.a, found.b), strict=True)]
    lines = [*runs, *_conditions(found.conditions), *([THINNED] if found.thinned else [])]
    if found.first is None:
        return [*lines, "", f"Nothing was recorded otherwise: {same_words(found)}"]
    sections = (
        _first(found.first, found.measures),
        _parted(found.parted),
        _unlike("Searches", "with as many places", found.searches, search_words),
        _unlike("Guarded motions", "ended alike", found.stops, stop_words),
        _corrected(found.corrections),
        _took(found),
    )
    return [*lines, *(line for section in map(tuple, sections) if section for line in ("", *section))]


def _conditions(differing: Sequence[Condition]) -> Iterator[str]:
    """Conditions that differ; the runs are compared as far as they go."""
    for each in differing:
        if each.what == "plan":
            yield "They are of different plans, compared as far as these go; `handeye diff` compares plans."
        else:
            yield f"{each.what}: {each.a} in A, {each.b} in B"


# -- what went otherwise ---------------------------------------------------------------------------------------


def _first(first: First, measures: Measures) -> Iterator[str]:
    yield f"Recorded otherwise first: {moment_words(first)}"
    yield from (f"  {line}" for line in first_words(first, measures))


def _parted(parted: Divergence | None) -> Iterator[str]:
    if parted is None:
        yield "Both went the same way: the same steps, stops, errors and answers."
        return
    yield f"Their ways part: {place_words(parted.place)}"
    yield f"  A: {turning_words(parted.a)}"
    yield f"  B: {turning_words(parted.b)}"


# -- what each searched, felt and corrected ------------------------------------------------------------------------


def _unlike(
    what: str, alike: str, found: Sequence[Searches | Stops], words: Callable[[Any], str]
) -> Iterator[str]:
    yield from _counted(what, alike, found)
    for each in found:
        if each.a is not None and each.b is not None and not each.alike:
            yield f"  {place_words(each.a.place)}: A {words(each.a)}, B {words(each.b)}"


def _corrected(found: Sequence[Corrections]) -> Iterator[str]:
    yield from _counted("Corrections", f"within {ASTRAY / INCH:.2f} in of each other", found)
    for each in found:
        if each.a is not None and each.b is not None and each.apart is not None and not each.alike:
            told = f"{each.a.name} in A {correction_words(each.a)}, in B {correction_words(each.b)}"
            yield f"  {place_words(each.a.place)}: {told}: {each.apart / INCH:.2f} in apart"


def _counted(what: str, alike: str, found: Sequence[Searches | Stops | Corrections]) -> Iterator[str]:
    """The number of findings in both runs, and how many are alike; nothing if there are none."""
    both = [each for each in found if each.a is not None and each.b is not None]
    if found:
        counts = sum(each.b is None for each in found), sum(each.a is None for each in found)
        alone = "".join(f"; {n} in {letter} alone" for letter, n in zip(_BOTH, counts, strict=True) if n)
        yield f"{what}: {len(both)} in both, {sum(each.alike for each in both)} {alike}{alone}"


# -- what they took --------------------------------------------------------------------------------------------


def _took(found: Comparison) -> Iterator[str]:
    """A row for each stage and for all: simulated seconds of both, and B's excess."""
    wide = max(map(len, ("Seconds", *(stage.name for stage in found.stages))))
    yield f"{'Seconds':{wide}}{'A':>9}{'B':>9}{'B - A':>9}"
    for stage in found.stages:
        yield _row(stage.name, wide, *stage.seconds)
    yield _row("all", wide, found.a.seconds, found.b.seconds)


def _row(name: str, wide: int, a: float | None, b: float | None) -> str:
    longer = "" if a is None or b is None else f"{b - a:+z.1f}"
    cells = (*("-" if seconds is None else f"{seconds:.1f}" for seconds in (a, b)), longer)
    return f"{name:{wide}}" + "".join(f"{cell:>9}" for cell in cells)
