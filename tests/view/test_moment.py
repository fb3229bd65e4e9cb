"""What those who look on are shown is a copy of what the arm sensed and the program estimated."""

import numpy as np
import pytest
from short_runs import begin
from toy_system import begin_toy

from handeye.execution.servo import ServoPeriod
from handeye.ports.workcell import Sensed
from handeye.program.events import ErrorRaised
from handeye.report.facts.seen import SeenPicture
from handeye.runs.advance import advance
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.trace.frames import Frames
from handeye.view.moment import FIGURES, Moment, Newest, Television

pytestmark = pytest.mark.slow
FEEL = """\
TRANS   ABOVE [25 38 .5 90 90 0]
        OPEN    1
        MOVE    ABOVE
        STOP    [0 0 -40]
        CHANGE  [0 0 -1] 1 .2
"""


class Moments(Observer):
    """Keeps what the newest moment was at each servo period."""

    def __init__(self, runner: Runner) -> None:
        self.newest = Newest(runner)
        self.all: list[Moment] = []

    def tick(self, period) -> None:
        self.newest.tick(period)
        self.all.append(self.newest.moment)


@pytest.fixture(scope="module")
def looked() -> tuple[Runner, Moments]:
    """A run that feels for the table, and somebody who looked on all the time."""
    kept: list[Moments] = []

    def looking(runner: Runner) -> list[Observer]:
        kept.append(Moments(runner))
        return [*kept]

    runner = Runner(begin(FEEL), observers=looking)
    advance(runner)
    return runner, kept[0]


def test_a_moment_stays_what_it_was(looked: tuple[Runner, Moments]) -> None:
    moments = looked[1].all
    heights = np.array([moment.poses[:, 2] for moment in moments])
    assert np.nanmax(np.ptp(heights, axis=0)) > 0.1
    assert np.ptp([moment.joints[1] for moment in moments]) > 0.1
    assert np.all(np.diff([moment.time for moment in moments]) > 0)


def test_force_is_there_only_while_it_is_estimated(looked: tuple[Runner, Moments]) -> None:
    estimated = [moment.force is not None for moment in looked[1].all]
    first, last = estimated.index(True), len(estimated) - 1 - estimated[::-1].index(True)
    assert all(estimated[first : last + 1])
    assert last == len(estimated) - 3  # then the program ends, and the brakes bear the forces
    assert looked[1].all[last].force[2] == pytest.approx(-11, abs=4)


def test_a_run_that_goes_back_is_shown_where_it_then_is(looked: tuple[Runner, Moments]) -> None:
    runner, moments = looked
    runner.back_to(1)
    newest, frames = moments.newest.moment, Frames(runner.cell.truth, runner.task.arm)
    moments.newest.undone(len(runner.events))
    assert moments.newest.moment is not newest
    assert moments.newest.moment.force is None
    np.testing.assert_array_equal(moments.newest.moment.poses[frames.there()], frames.poses()[frames.there()])
    assert moments.newest.moment.time == runner.time


def test_a_moment_is_sent_as_32_bit_numbers() -> None:
    poses = np.arange(14, dtype=np.float32).reshape(2, 7)
    moment = Moment(
        time=2.5, gap=0.03, force=None, joints=np.array([1.0, 2.0]), poses=poses, channels=np.empty(0)
    )
    numbers = np.frombuffer(moment.packed, "<f4")
    assert numbers[:2].tolist() == pytest.approx([2.5, 0.03])
    assert np.isnan(numbers[2:FIGURES]).all()
    assert numbers[FIGURES:].tolist() == [1, 2, *range(14)]


def test_a_system_without_a_cell_has_moments_too() -> None:
    newest = Newest(Runner(begin_toy()))
    assert newest.moment.poses.shape == (0, 7)


def test_what_is_copied_is_neither_changed_nor_kept() -> None:
    newest, q, wrench = Newest(Runner(begin_toy())), np.ones(6), np.full(6, 2.0)
    sensed = Sensed(
        time=1.0, q=q, qd=np.zeros(6), gap=0.0, touch=(False, False), tool_torque=0.0, braked=False
    )
    for array in (q, wrench):
        array.setflags(write=False)
    newest.tick(ServoPeriod(sensed=sensed, effort=np.zeros(6), wrench=wrench))
    for array in (q, wrench):
        array.setflags(write=True)
        array += 1
    assert newest.moment.joints.tolist() == [1] * 6
    assert newest.moment.force is not None
    assert newest.moment.force.tolist() == [2] * 3


def test_an_error_that_is_none_of_the_eye_sends_no_picture_again(monkeypatch: pytest.MonkeyPatch) -> None:
    pictures = [Television(picture()), Television(picture()), Television(picture("LATER"))]
    monkeypatch.setattr("handeye.view.moment.television", lambda _: pictures.pop(0))
    newest = Newest(Runner(begin_toy()))
    before = newest.television
    newest.event(ErrorRaised(time=2.0, number=23, cause=None))
    assert newest.television is before
    newest.undone(0)
    assert newest.television.picture is not None
    assert newest.television.picture.name == "LATER"


def picture(name: str = "NEAR") -> SeenPicture:
    """A picture in which nothing was found."""
    points = np.zeros((3, 4), dtype=np.uint8)
    return SeenPicture(time=1.0, name=name, lens=0.05, picture=points, marks=(), findings=())
