"""Parts at rest sleep and clamped parts move as one: cheaper, and otherwise the same."""

from functools import cache

import numpy as np
import pytest
from driving import tick
from finished import enter, stacked, tighten

from handeye.cell.simulated import SimulatedCell
from handeye.tasks.stanford_cell.dimensions import dimensions

PARTS = ("base", "gasket", "top")


@cache
def screwed(rest: bool) -> SimulatedCell:
    """Three screws in, one after the other; the third with the parts clamped, if that is allowed."""
    cell = stacked(rest=rest)
    for hole in (0, 3, 4):
        tighten(cell, hole)
    return cell


def bonded(cell: SimulatedCell) -> bool:
    truth = cell.truth
    return bool(truth.data.eq_active[truth.model.equality("merge_top").id])


@pytest.mark.slow
def test_with_and_without_rest_the_parts_end_within_a_twentieth_of_a_millimetre() -> None:
    cells = [screwed(rest).truth for rest in (True, False)]
    places = [np.array([t.data.xpos[t.model.body(part).id] for part in PARTS]) for t in cells]
    assert np.abs(places[0] - places[1]).max() < 5e-5


@pytest.mark.slow
def test_only_with_rest_the_clamped_parts_are_bonded() -> None:
    assert (bonded(screwed(True)), bonded(screwed(False))) == (True, False)


@pytest.mark.slow
def test_an_unclamped_stack_is_not_bonded() -> None:
    cell = stacked()
    tighten(cell, 0)
    assert not bonded(cell)


@pytest.mark.slow
@pytest.mark.parametrize(("into", "held"), [(-0.05e-3, True), (0.15e-3, False)])
def test_a_shank_that_presses_harder_than_friction_parts_the_bond(into: float, held: bool) -> None:
    cell = stacked()
    for hole in (0, 3):
        tighten(cell, hole)
    assert bonded(cell)
    play = dimensions()("top.screw_hole_radius") - dimensions()("screw.shank_radius")
    enter(cell, 4, 4, 0.002, aside=play + into)
    still = []
    for _ in range(3):
        tick(cell.devices)
        still.append(bonded(cell))
    assert all(still) == held


@pytest.mark.slow
def test_bonding_leaves_the_contacts_of_a_copy_as_they_were() -> None:
    truth = screwed(True).truth
    model, data = truth.copy()
    lands = np.isin(model.geom_contype, (64, 128))
    assert lands.sum() == 12
    assert not data.eq_active[model.equality("merge_top").id]


@pytest.mark.slow
def test_a_finished_stack_falls_asleep() -> None:
    cell = screwed(True)
    for _ in range(60):
        tick(cell.devices)
    assert cell.truth.data.ntree_awake == 0
