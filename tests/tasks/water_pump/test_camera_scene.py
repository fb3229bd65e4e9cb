"""The eye on the rendered pump: both renderers, both looks, the gasket (reference 8, rows 46, 51 to 53)."""

import math

import numpy as np
import pytest

from handeye.core.faults import Fault
from handeye.core.units import INCH
from handeye.core.variation import WorldSpec
from handeye.program.diagnosis.cause_text import cause_sentence
from handeye.tasks.water_pump.trials.base import BaseTrial
from handeye.tasks.water_pump.trials.gasket import ABSENT, RIGHT, SHIFTED, GasketTrial
from handeye.tasks.water_pump.trials.still_pump import StillPump, locate, look, pump_base
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.vision.base import Failure, SpecificLocation, locate_specific
from handeye.vision.drawing import annotate
from handeye.vision.marks import marks

pytestmark = [pytest.mark.render, pytest.mark.slow]

PART = pump_base()
CALIBRATED, GASKETS = 2, 4
"""Drawn worlds in which the arm calibrates the camera, and in which gaskets are looked at."""
POSES = 3
"""At which the base is looked at in each."""


def found(seed: int, renderer: str) -> SpecificLocation | Failure:
    still = StillPump(PumpWorld.sample(seed), renderer=renderer)
    return locate(still.camera, still.true_camera, PART)[0]


def test_both_renderers_put_the_holes_at_the_same_place_to_a_point():
    first, second = found(3, "auto"), found(3, "ray")
    for a, b in zip(first.holes, second.holes, strict=True):
        assert math.hypot(a.u - b.u, a.v - b.v) < 1


def test_the_base_is_found_to_a_fiftieth_of_an_inch_in_a_world_without_errors():
    still = StillPump(PumpWorld.nominal())
    location, _ = locate(still.camera, still.true_camera, PART)
    base = still.world.base
    assert location.pose[:2] == pytest.approx((base.x, base.y), abs=0.02 * INCH)


@pytest.mark.row(46, drawn=CALIBRATED)
def test_every_base_is_found_and_none_mistaken_by_a_camera_that_the_arms_own_lamp_has_calibrated():
    trial = BaseTrial()
    tries = [
        attempt
        for seed in range(40, 40 + CALIBRATED)
        for attempt in trial.attempts(WorldSpec(seed=seed), POSES, camera="auto", known="lamp")
    ]
    counted = trial.count(tries).figures
    assert (counted["found"], counted["wrong"]) == (len(tries), 0)
    assert counted["within"] >= len(tries) - 1


def test_fresh_poses_of_the_base_lie_on_the_belt_and_the_first_is_that_of_the_world():
    tries = list(BaseTrial().attempts(WorldSpec(seed=5), 3, camera="auto", known="true"))
    assert [(a.seed, a.number, a.wrong) for a in tries] == [(5, 0, False), (5, 1, False), (5, 2, False)]
    assert all(attempt.within for attempt in tries)


@pytest.mark.row(51, drawn=GASKETS)
@pytest.mark.row(52, drawn=GASKETS)
@pytest.mark.row(53, drawn=GASKETS)
@pytest.mark.parametrize("seed", range(42, 42 + GASKETS))
def test_a_gasket_is_accepted_only_where_it_belongs(seed: int):
    (tried,) = GasketTrial().attempts(WorldSpec(seed=seed), 1, camera="auto", known="sightings")
    assert {case: tried.accepted[case] for case in (RIGHT, SHIFTED, ABSENT)} == {
        RIGHT: True, SHIFTED: False, ABSENT: False,
    }  # fmt: skip


def test_a_gasket_with_a_torn_corner_is_rejected_where_it_belongs():
    torn = Fault(name="gasket.torn", value=0.018)
    (tried,) = GasketTrial().attempts(WorldSpec(seed=42, faults=(torn,)), 1, camera="auto", known="sightings")
    assert not tried.accepted[RIGHT]


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_forgotten_refocus_fails_with_a_clear_message(seed: int):
    still = StillPump(PumpWorld.sample(seed))
    _, pictures = locate(still.camera, still.true_camera, PART)
    general = pictures[0][2]
    view = pictures[1][1]
    still.camera.focus(math.inf)
    picture = still.camera.digitise()
    failure = locate_specific(picture, view, PART, general)
    assert isinstance(failure, Failure)
    assert "is the picture in focus" in cause_sentence(failure.cause)


def test_the_overlay_marks_the_line_of_centres():
    still = StillPump(PumpWorld.sample(3))
    location, pictures = locate(still.camera, still.true_camera, PART)
    image = annotate(pictures[1][0], marks(specific=location))
    middle = np.mean([(hole.u, hole.v) for hole in location.holes], axis=0)
    column, row = (np.rint((middle + 0.5) * 3)).astype(int)
    blue, _, red = image[row, column].astype(int)
    assert red > blue + 60


def test_looking_twice_at_one_place_gives_the_same_view():
    still = StillPump(PumpWorld.sample(3))
    first = look(still.camera, still.true_camera, 0.025, PART.at[:3])
    assert look(still.camera, still.true_camera, 0.025, PART.at[:3]) == first
