"""The 3D view draws over the cell what the trace holds: forces, held objects, and the places of a search."""

import json
from dataclasses import replace

import numpy as np
import pytest
from report_pages import no_photographs, tree
from short_runs import FEEL, GRASP, plan_of, traced

from handeye.core.variation import WorldSpec
from handeye.report.animation import animation
from handeye.report.facts.felt import guarded_motions
from handeye.report.facts.planned import Search, searches
from handeye.report.facts.sensed import FORCE, held_objects, sensed_forces, tried_places
from handeye.report.page.document import report_page
from handeye.report.recorded import RecordedRun
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint

pytestmark = pytest.mark.slow


SEARCH = """
TRANS   ABOVE [25 38 .5 90 90 0]
        STAGE   "search"
        SEARCH  .3 STEPS 1
AGAIN:  SKIPN   6
        JUMP    NONE
        MOVE    ABOVE
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] 1 .5
        SKIPE   23
        AOJ     AGAIN
NONE:   OPEN    1
"""


def recorded(script: str, folder: pytest.TempPathFactory) -> RecordedRun:
    start = Checkpoint(setup=Setup(plan=plan_of(script), world=WorldSpec(seed=0), camera="ray"))
    return RecordedRun(trace=traced(start, folder.mktemp("sensed") / "run"))


@pytest.fixture(scope="module")
def felt(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    """A run that feels for the table, and then for nothing."""
    return recorded(FEEL, tmp_path_factory)


@pytest.fixture(scope="module")
def grasped(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    """A run that takes a pin, and searches with it in the air."""
    return recorded(GRASP, tmp_path_factory)


def test_between_the_drawn_moments_every_force_is_within_the_tolerance(felt: RecordedRun) -> None:
    motions, drawn = felt.trace.forces().motions(), sensed_forces(felt)
    assert len(drawn) == len(motions) == 2
    for motion, thin in zip(motions, drawn, strict=True):
        assert len(thin.times) < len(motion.times)
        for column, kept in zip(motion.force.T, thin.forces.T, strict=True):
            between = np.interp(motion.times, thin.times, kept)
            assert np.abs(between - column).max() <= FORCE + 1e-9


def test_the_limit_is_that_of_the_guard(felt: RecordedRun) -> None:
    assert [motion.limit for motion in sensed_forces(felt)] == pytest.approx([11.12, 11.12], abs=0.01)


def test_the_pin_is_held_from_the_grasp_until_the_hand_opens(grasped: RecordedRun) -> None:
    (pin,) = held_objects(grasped)
    assert pin.name == "PIN"
    gaps = np.interp([pin.begin, pin.end], grasped.trace.times, grasped.trace.gaps)
    assert gaps == pytest.approx([0.0064, 0.0064], abs=0.002)  # a pin of 1/4 in


@pytest.fixture(scope="module")
def searched(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    """A run that looks for a hole at nine places of the table, where there is none."""
    return recorded(SEARCH, tmp_path_factory)


def test_each_tried_place_has_its_moment(searched: RecordedRun) -> None:
    motions, (search,) = guarded_motions(searched), searches(searched)
    (places,) = tried_places([search], motions)
    assert places.times == tuple(float(motion.times[-1]) for motion in motions)
    assert len(places.times) == len(search.places) == 9
    assert not places.found


def test_a_search_that_tried_all_places_found_none(grasped: RecordedRun) -> None:
    motions = guarded_motions(grasped)
    search = Search(
        step=motions[0].step, times=(float(motions[0].times[-1]),), places=((0, 0), (1, 0)), exhausted=True
    )
    assert [places.found for places in tried_places([search], motions)] == [False]
    assert [places.found for places in tried_places([replace(search, exhausted=False)], motions)] == [True]


def test_the_page_carries_them(felt: RecordedRun) -> None:
    page = report_page(felt, no_photographs(felt), animation(felt)).decode()
    told = json.loads(tree(page).one("sensed").text)
    assert [motion["limit"] for motion in told["forces"]] == pytest.approx([11.12, 11.12], abs=0.01)
    assert [tool["body"] for tool in told["tools"]] == ["stanford/link6"]
