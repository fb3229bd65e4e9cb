"""The drawing fits its own parts: six screws pass gasket and top wherever the pins let those lie."""

import runpy
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from handeye.core.resources import scenes
from handeye.tasks.water_pump.world.variation import variation

pytestmark = pytest.mark.slow

STACK = SimpleNamespace(**runpy.run_path(str(scenes() / "water_pump" / "tolerance_stack.py")))
WORLDS = 5_000


@pytest.mark.parametrize("layer", ["gasket", "top"])
def test_six_screws_pass_a_rightly_placed_layer(layer: str) -> None:
    found = STACK.stack(STACK.Sizes.drawn(layer), layer, WORLDS)
    assert not found.binds.any()
    assert found.laid.max() < found.clearance


@pytest.mark.parametrize("layer", ["gasket", "top"])
def test_they_pass_with_the_play_that_pins_have_in_the_simulation(layer: str) -> None:
    drawn = STACK.Sizes.drawn(layer)
    found = STACK.stack(replace(drawn, body=drawn.body - STACK.SOFT), layer, WORLDS)
    assert found.laid.max() < found.clearance


def test_a_close_fit_would_let_screws_cut_into_the_top_in_most_worlds() -> None:
    close = replace(STACK.Sizes.drawn("top"), hole=3.264e-3, body=3.15e-3, nose=2.45e-3)
    found = STACK.stack(close, "top", WORLDS)
    assert (found.laid > found.clearance).mean() > 0.5


def test_no_lie_is_worse_than_the_worst() -> None:
    found = STACK.stack(STACK.Sizes.drawn("top"), "top", WORLDS)
    assert (found.laid[: len(found.worst)] < found.worst + 2e-5).all()


def test_many_worlds_at_once_are_drawn_as_one_is() -> None:
    rng = np.random.default_rng(0)
    quantity = variation().quantities["holes.top.1.x"]
    one = [quantity.distribution.draw(rng, 0.0) * quantity.measure.size for _ in range(WORLDS)]
    many = STACK._drawn("holes.top.1.x", WORLDS, rng)
    assert many.std() == pytest.approx(np.std(one), rel=0.05)
    assert many.max() == max(one)


def test_the_table_has_a_line_for_each_layer_as_drawn_and_as_met() -> None:
    assert [line[:16].strip() for line in STACK.table(100)][2:] == [
        f"{layer} as {what}" for layer in ("gasket", "top") for what in ("drawn", "met")
    ]
