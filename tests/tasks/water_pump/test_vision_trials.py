"""Trials of the eye in many worlds: what they try, what they count, and how their commands end."""

import json
from collections.abc import Iterator

import pytest
from conftest import Command

from handeye.core.units import DEGREE, INCH
from handeye.core.variation import WorldSpec
from handeye.tasks.water_pump.trials.base import BaseAttempt, BaseTrial
from handeye.tasks.water_pump.trials.gasket import ABSENT, DOUBLED, RIGHT, SHIFTED, GasketAttempt, GasketTrial

CASES = (RIGHT, SHIFTED, ABSENT, DOUBLED)


def gaskets(monkeypatch: pytest.MonkeyPatch, *accepted: str) -> None:
    """Let the eye accept these."""

    def attempts(self: GasketTrial, world: WorldSpec, number: int, **_: str) -> Iterator[GasketAttempt]:
        for k in range(number):
            yield GasketAttempt(
                seed=world.seed, number=k, accepted={case: case in accepted for case in CASES}
            )

    monkeypatch.setattr(GasketTrial, "attempts", attempts)


def bases(monkeypatch: pytest.MonkeyPatch, **found: object) -> None:
    """Let the eye find the base so."""

    def attempts(self: BaseTrial, world: WorldSpec, number: int, **_: str) -> Iterator[BaseAttempt]:
        yield from (BaseAttempt(seed=world.seed, number=k, **found) for k in range(number))  # type: ignore[arg-type]

    monkeypatch.setattr(BaseTrial, "attempts", attempts)


@pytest.mark.parametrize(
    ("accepted", "code"), [([RIGHT], 0), ([], 0), ([RIGHT, DOUBLED], 0), ([SHIFTED], 3), ([RIGHT, ABSENT], 3)]
)
def test_a_gasket_accepted_that_the_eye_can_tell_ends_the_trials_with_three(
    command: Command, monkeypatch: pytest.MonkeyPatch, accepted: list[str], code: int
) -> None:
    gaskets(monkeypatch, *accepted)
    ended, out, _ = command("trials", "gasket", "--n", "2", "--jobs", "1")
    assert ended == code
    assert f"right        accepted {2 * (RIGHT in accepted)} of 2" in out.splitlines()


def test_something_else_taken_for_the_base_ends_the_trials_with_three(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    bases(monkeypatch, error=(INCH, 0.0, 0.0), wrong=True)
    code, out, _ = command("trials", "base", "--n", "2", "--jobs", "1")
    assert code == 3
    assert "found 2 of 2, 2 of them wrong" in out.splitlines()


def test_a_base_is_within_where_the_paper_says_and_not_farther(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    for error, within in (((0.33, -0.24), 3), ((0.34, 0.0), 0), ((0.0, 0.26), 0)):
        bases(monkeypatch, error=(error[0] * INCH, error[1] * INCH, DEGREE))
        told = command("trials", "base", "--n", "3", "--jobs", "1")[1]
        assert f"{within} within 0.33 inches along x and 0.25 inches along y" in told


def test_a_base_that_was_not_found_says_why_and_counts_as_tried(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    bases(monkeypatch, error=None, failure="there is nothing")
    code, out, _ = command("trials", "base", "--n", "1", "--seed", "7", "--jobs", "1")
    assert (code, out.splitlines()[:2]) == (
        0,
        ["seed    7  there is nothing", "found 0 of 1, 0 of them wrong"],
    )


def test_poses_are_shared_out_among_worlds_and_told_as_json(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    bases(monkeypatch, error=(0.0, 0.0, 0.0))
    _, out, err = command(
        "trials", "base", "--n", "5", "--worlds", "2", "--seed", "3", "--jobs", "1", "--json"
    )
    told = json.loads(out)
    assert [(a["seed"], a["number"]) for a in told["attempts"]] == [(3, 0), (3, 1), (3, 2), (4, 0), (4, 1)]
    assert (told["worlds"], told["tried"], told["found"], told["eye"]) == (2, 5, 5, "lamp")
    assert err.startswith("seed    3  found, off by x +0.000 in")
