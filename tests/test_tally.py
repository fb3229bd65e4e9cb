"""Whoever waits for many trials is told how many have ended, and about how long the others take."""

import io

import pytest
from rich.console import Console

from handeye.cli.tally import LINES, Tally, duration


class Seconds:
    """A clock that somebody sets."""

    def __init__(self) -> None:
        self.now = 0.0

    def __call__(self) -> float:
        return self.now


def told(total: int) -> list[str]:
    """What is told, where there is no terminal, of trials that take ten seconds each."""
    out, clock = io.StringIO(), Seconds()
    for _ in Tally(total, "runs", Console(file=out, width=80), clock).counting(range(total)):
        clock.now += 10
    return out.getvalue().splitlines()


def test_of_a_few_trials_each_is_told() -> None:
    assert told(3) == ["1 of 3 runs, about 20 s to go", "2 of 3 runs, about 10 s to go", "3 of 3 runs"]


def test_of_many_trials_not_every_one_is_told() -> None:
    assert len(told(1000)) == LINES + 1


@pytest.mark.parametrize(("seconds", "said"), [(3, "about 10 s"), (44, "about 40 s"), (700, "about 12 min")])
def test_durations_are_round(seconds: float, said: str) -> None:
    assert duration(seconds) == said
