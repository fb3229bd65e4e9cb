"""Trials of the eye in many worlds: what they count, and how the command ends."""

import pytest
from conftest import Command

from handeye.tasks.water_pump import vision_trials
from handeye.tasks.water_pump.vision_trials import GASKETS, GasketCounts


@pytest.mark.parametrize(
    ("accepted", "code"),
    [((2, 0, 0, 0), 0), ((0, 0, 0, 0), 0), ((2, 1, 0, 0), 3), ((2, 0, 0, 1), 3)],
)
def test_a_gasket_accepted_where_it_does_not_belong_ends_the_trials_with_three(
    command: Command, monkeypatch: pytest.MonkeyPatch, accepted: tuple[int, ...], code: int
) -> None:
    counts = GasketCounts(tried=2, accepted=dict(zip(GASKETS, accepted, strict=True)))
    monkeypatch.setattr(vision_trials, "gasket_trials", lambda *_, **__: counts)
    ended, out, _ = command("trials", "gasket", "2")
    assert (ended, out.splitlines()[0]) == (code, f"right        accepted {accepted[0]} of 2")
