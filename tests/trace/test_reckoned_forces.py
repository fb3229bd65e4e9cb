"""Force that is reckoned from joints and drives is what the program felt, where and as long as it felt it."""

from dataclasses import replace

import numpy as np
import pytest
from short_runs import FEEL, plan_of, traced

from handeye.core.errors import InvalidInput
from handeye.core.variation import Overrides, WorldSpec
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.trace.channels import HAND
from handeye.trace.forces import Forces
from handeye.trace.trace import Trace

pytestmark = pytest.mark.slow

SCRIPT = f"""
TRANS   PIVOT [30 38 .5 90 90 0]
{FEEL}
        FREE    1 X
        CHANGE  [0 0 1] .1      ;gives way, without a guard
        STOP    40
        TURN    PIVOT 5         ;meets nothing, and is watched whichever way it goes
        SKIPE   23
        OPEN    1
"""


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Trace:
    """The trace of a run that feels in every way, with an arm that knows nothing of itself, as in older traces."""
    world = WorldSpec(seed=0, overrides=Overrides(without=("arm",)))
    start = Checkpoint(setup=Setup(plan=plan_of(SCRIPT), world=world, camera="ray"))

    def forget(runner: Runner) -> None:
        drive = runner.context.state.drive
        drive.friction, drive.links = np.zeros_like(drive.friction), None

    return traced(start, tmp_path_factory.mktemp("felt") / "run", prepare=forget)


@pytest.fixture(scope="module")
def old(trace: Trace) -> Trace:
    """The same without a record of force."""
    kept = tuple(message for message in trace.messages if message.topic != HAND)
    counts = {topic: count for topic, count in trace.counts.items() if topic != HAND}
    return replace(trace, messages=kept, counts=counts, version=2)


@pytest.fixture(scope="module")
def both(trace: Trace, old: Trace) -> tuple[Forces, Forces]:
    return trace.forces(), old.forces()


def test_it_says_in_which_way_it_was_got(both: tuple[Forces, Forces]) -> None:
    assert [forces.recorded for forces in both] == [True, False]


def test_it_is_told_in_the_same_servo_periods(both: tuple[Forces, Forces]) -> None:
    recorded, reckoned = both
    assert len(recorded.motions()) == 4
    assert np.array_equal(recorded.estimated, reckoned.estimated)


def test_it_is_nearly_what_the_program_felt(both: tuple[Forces, Forces]) -> None:
    recorded, reckoned = both
    known = recorded.estimated
    assert np.abs(recorded.force[known] - reckoned.force[known]).max() < 0.2
    assert np.abs(recorded.moment[known] - reckoned.moment[known]).max() < 0.05
    assert recorded.force[known, 2].min() < -11


def test_the_same_guards_watch_along_the_same_axes(both: tuple[Forces, Forces]) -> None:
    recorded, reckoned = both
    assert set(recorded.guard) == {"", "force", "against"}
    assert np.array_equal(recorded.guard, reckoned.guard)
    assert np.array_equal(np.isnan(recorded.value), np.isnan(reckoned.value))
    np.testing.assert_allclose(recorded.limit, reckoned.limit, atol=1e-6)
    np.testing.assert_allclose(recorded.axis, reckoned.axis, atol=0.2)


def test_a_trip_is_the_only_value_beyond_its_limit(both: tuple[Forces, Forces]) -> None:
    for forces in both:
        (row,) = np.flatnonzero(forces.value > forces.limit)
        assert (
            row == np.flatnonzero(forces.estimated & (forces.guard == "force") & (forces.axis[:, 2] < 0))[-1]
        )


def test_a_camera_that_the_scene_does_not_have_is_refused(trace: Trace) -> None:
    with pytest.raises(InvalidInput, match=r"^no camera nowhere; there are .*studio"):
        trace.frame(trace.head.time + 1.0, "nowhere")


@pytest.mark.parametrize("sides", [{"width": "a"}, {"height": 640.5}])
def test_a_size_that_is_none_is_refused(trace: Trace, sides: dict[str, object]) -> None:
    with pytest.raises(InvalidInput, match=r"^a picture of .* cannot be made; a side has 8 to 2048 points$"):
        trace.frame(trace.head.time + 1.0, **sides)


def test_the_cell_of_the_first_version_is_not_photographed(trace: Trace) -> None:
    with pytest.raises(
        InvalidInput, match=r"was recorded by an older handeye, whose cell this one cannot build"
    ):
        replace(trace, version=1).frame(1.0)
