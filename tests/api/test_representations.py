"""What is printed at the prompt of Python fits on a screen, whatever a value holds."""

from collections.abc import Iterator
from typing import Any

import numpy as np
import pytest

import handeye
from handeye import trials, vision
from handeye.core.brief import LONGEST, Brief, Named, Several, brief
from handeye.core.record import Record

SCRIPT = "OPEN 1\nOPEN 2\n"


def parts(value: Any) -> Iterator[Any]:
    """A value, and what its public attributes are."""
    yield value
    for name in dir(value):
        if not name.startswith("_"):
            try:
                part = getattr(value, name)
            except handeye.HandeyeError:
                continue
            if not callable(part):
                yield part


def shown() -> Iterator[Any]:
    """Values that Python's door gives."""
    trace = handeye.open(handeye.demo)
    run = handeye.begin(SCRIPT, camera="ray")
    yield from (
        trace,
        trace.forces(),
        trace.at(100),
        trace.pictures[0],
        trace.table(),
        trace.table().columns[0],
    )
    yield from (run, run.step(), run.say("where"), handeye.plan(SCRIPT), handeye.World(seed=3))
    yield from (handeye.compare(handeye.demo, handeye.demo), vision.Scan(trace.pictures[0].picture))
    yield from (handeye.tasks.task(name) for name in ("water_pump", "insertion"))
    yield handeye.assemble(script=SCRIPT, camera="ray")
    yield trials.assemble_each(range(3), script=SCRIPT, camera="ray")


@pytest.mark.slow
def test_the_representation_of_whatever_is_handed_out_fits_on_a_screen() -> None:
    told = [
        (type(value).__name__, type(part).__name__, repr(part)) for value in shown() for part in parts(value)
    ]
    assert [
        (one, other, text[:300]) for one, other, text in told if len(text) > 2000 and other != "bytes"
    ] == []
    assert [text for *_, text in told if text.count("\n") > 24] == []
    assert {text for *_, text in told if "handeye" in text and " object at 0x" in text} == set()


class Pair(Record, frozen=True):
    name: str
    values: tuple[int, ...]
    inner: "Pair | None" = None


def test_small_records_are_shown_whole_and_large_ones_by_their_beginning() -> None:
    assert repr(Pair(name="a", values=(1, 2))) == "Pair(name='a', values=(1, 2), inner=None)"
    assert (
        repr(Pair(name="a", values=tuple(range(100))))
        == "Pair(name='a', values=(0, 1, 2, … 97 more), inner=None)"
    )
    deep = Pair(name="z", values=())
    for name in "yxwv":
        deep = Pair(name=name, values=(), inner=deep)
    assert repr(deep).endswith("inner=Pair(name='x', values=(), inner=Pair(…))))")


def test_arrays_are_told_by_their_shapes_and_texts_are_cut() -> None:
    assert brief({"a": np.zeros((3, 4))}) == "{'a': <array 3 x 4>}"
    assert len(brief(["x" * 10_000] * 4)) <= LONGEST
    assert len(brief(Several("y" * 1000 for _ in range(1000)))) <= LONGEST
    assert repr(Several([1])) == "(1,)"
    assert repr(Named(enumerate("abcdef"))) == "{0: 'a', 1: 'b', 2: 'c', … 3 more}"
    assert Several([1, 2]) == (1, 2)
    assert Brief.__repr__ is Record.__repr__
