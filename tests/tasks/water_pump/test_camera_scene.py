"""The eye on the rendered pump: both renderers, both looks, the gasket (reference 8, rows 46, 51 to 53)."""

import math

import numpy as np
import pytest

from handeye.program.cause_text import cause_sentence
from handeye.tasks.water_pump.pump_world import PumpWorld
from handeye.tasks.water_pump.vision_trials import (
    StillPump,
    base_trials,
    gasket_trials,
    locate,
    look,
    pump_base,
)
from handeye.units import INCH
from handeye.variation import WorldSpec
from handeye.vision.base import Failure, SpecificLocation, locate_specific
from handeye.vision.drawing import annotate
from handeye.vision.marks import marks

pytestmark = [pytest.mark.render, pytest.mark.slow]

PART = pump_base()
BASES, GASKETS = 4, 1
"""Drawn worlds in which they are looked at."""


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


@pytest.mark.row(46, drawn=BASES)
def test_every_base_of_a_few_random_worlds_is_found_and_none_is_mistaken():
    counts = base_trials(BASES, WorldSpec(seed=40), camera="calibrated")
    assert (counts.found, counts.wrong) == (BASES, 0)
    assert counts.within >= BASES - 1


@pytest.mark.row(51, drawn=GASKETS)
@pytest.mark.row(52, drawn=GASKETS)
@pytest.mark.row(53, drawn=GASKETS)
def test_a_gasket_is_accepted_only_where_it_belongs():
    assert gasket_trials(GASKETS, WorldSpec(seed=42)).accepted == {
        "right": 1,
        "shifted .15": 0,
        "shifted .3": 0,
        "absent": 0,
    }


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_a_forgotten_refocus_fails_with_a_clear_message(seed: int):
    still = StillPump(PumpWorld.sample(seed))
    _, pictures = locate(still.camera, still.true_camera, PART)
    general = pictures[0][2]
    view = pictures[1][1]
    still.camera.focus(math.inf)
    picture, _ = still.camera.digitise()
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
