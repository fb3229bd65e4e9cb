"""The exercise on vision: right and wrong programs, each in a world that shows the difference.

A run calibrates the camera with the arm's lamp, which takes more than 20 s of processor time. Here the sightings of
the lamp are simulated. Everything after the calibration is as in a run.
"""

from functools import cache, partial
from pathlib import Path

import pytest

from handeye.core.source import Source, read_source
from handeye.core.variation import WorldSpec
from handeye.exercises import exercises
from handeye.exercises.exercise import Grade, Submission
from handeye.systems.stanford import executor_run
from handeye.tasks.water_pump.trials.still_pump import StillPump, by_sightings, pump_base
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.vision.calibration import Calibration

SEE = exercises()["see"]
SOLUTION = read_source(Path(__file__).parent / "solutions" / "see.al")


@cache
def calibrated(seed: int) -> Calibration:
    still = StillPump(PumpWorld.draw(WorldSpec(seed=seed)), renderer="ray")
    return by_sightings(still, pump_base().at[:3])


@pytest.fixture
def graded(monkeypatch: pytest.MonkeyPatch) -> partial[Grade]:
    """Grades a program in the world of a seed."""
    monkeypatch.setenv("HANDEYE_CACHE", "")  # a calibration from simulated sightings is not for other tests

    def grade(source: Source, seed: int) -> Grade:
        monkeypatch.setattr(executor_run, "calibrate_camera", lambda *_: calibrated(seed))
        return SEE.grade(Submission(source=source, taught=None, seeds=(seed,), jobs=1, told=lambda _: None))

    return partial(grade)


@pytest.mark.slow
def test_two_pictures_find_the_base_and_one_picture_does_not_show_its_direction(
    graded: partial[Grade],
) -> None:
    assert graded(SOLUTION, 0).exit_code == 0
    found = graded(SEE.program, 0)
    assert found.exit_code == 3
    assert "angle between the finger line and the line of the holes" in found.failures[0].reason
    assert "SPECIFIC finds its holes" in found.hints[0]


@pytest.mark.slow
def test_a_base_that_lies_the_wrong_way_round_is_a_reason_to_stop(graded: partial[Grade]) -> None:
    (verdict,) = graded(SOLUTION, 15).verdicts
    assert (verdict.standing, verdict.error) == ("right", 31)
    assert verdict.again.endswith("--task water_pump --seed 15 --fault base.reversed --out seed15")


@pytest.mark.slow
def test_a_program_that_trusts_the_plan_is_silently_wrong_where_no_base_is(graded: partial[Grade]) -> None:
    blind = Source(name="blind.al", text="        MOVE    OVER\n")
    assert graded(blind, 10).exit_code == 3
    assert graded(Source(name="idle.al", text='        WAIT    "HELP"\n'), 10).exit_code == 0


def test_a_program_may_not_change_the_taught_part() -> None:
    assert SEE.positions is not None
    moved = Source(name="mine.toml", text=SEE.positions.text.replace("region = [3.0", "region = [9.0"))
    given = Submission(source=SEE.program, taught=moved, seeds=(0,), jobs=1, told=lambda _: None)
    assert SEE.broken_rules(given) == ["mine.toml does not have the taught positions of the exercise"]
