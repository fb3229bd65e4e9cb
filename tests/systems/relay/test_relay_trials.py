"""Trials of a relay: what a row keeps of each leg, and the table of legs."""

from pathlib import Path

import pytest
from relay_bench import pin_relay, runner_of

from handeye.systems.relay.cli import commands
from handeye.systems.relay.trials import RELAYS, LegTrial, RelayRow, RelayWork
from handeye.trials.sweep import Case


def row(trial: int, result: str, *seconds: float) -> RelayRow:
    """A row whose legs took these seconds."""
    legs = tuple(
        LegTrial(stage=stage, system=system, ended="done", arm_s=s, peak_n=2 * s)
        for (stage, system), s in zip((("see", "program"), ("lay", "ml")), seconds, strict=False)
    )
    return RelayRow(trial=trial, seed=trial, result=result, legs=legs)


def test_a_leg_that_called_the_operator_has_not_ended_well() -> None:
    rows = [row(0, "right", 1.0, 4.0), row(1, "stopped", 3.0, 9.0), row(2, "stopped", 5.0)]
    (table,) = RELAYS.details(rows)
    assert table.cells() == [
        ("see", "the system of 1973", "3", "2", "2.0 s", "4", "6"),
        ("lay", "ML", "2", "1", "4.0 s", "8", "8"),
    ]
    assert [each.stage for each in rows] == ["", "lay", "see"]


@pytest.mark.slow
def test_a_row_has_the_time_and_the_greatest_force_of_each_leg(tmp_path: Path) -> None:
    setup = runner_of(pin_relay(tmp_path)).setup
    (found,) = RelayWork(setup)(Case(trials=(0,), seed=3))
    assert found.outcome == "silent"  # a pin has been carried, but there is no pump
    go, take, carry = found.legs
    assert [leg.stage for leg in found.legs] == ["go to the pin", "take the pin", "carry it on"]
    assert min(leg.arm_s for leg in found.legs) > 1
    assert go.peak_n == 0
    assert 1 < take.peak_n < 80
    assert carry.peak_n > 0.1


@pytest.mark.slow
def test_a_run_takes_the_renderer_that_was_asked_for(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    pin_relay(tmp_path)
    (tmp_path / "pin.relay").write_text('STAGE "go to the pin" take.al\n', encoding="utf-8")
    cameras = []
    monkeypatch.setattr(commands, "carry_out_job", lambda setup, _: cameras.append(setup.camera) or 0)
    assert commands.run(tmp_path / "pin.relay", camera="ray") == 0
    assert cameras == ["ray"]
