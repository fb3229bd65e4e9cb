"""The camera's mechanism is slow, and the arm need not wait for it: only a picture does."""

import numpy as np
import pytest
from fake_runs import FakeRun, fake_run
from fakes import FakeCamera
from synthetic import part

from handeye.ports.camera import COLUMNS, DIGITISE, ROWS, Picture
from handeye.program.events import AnyEvent, CameraBusy, CameraStarted, PictureTaken
from handeye.results.summary import overlapped

MECHANISM = 3.0
"""s that turret, mount and focus of the fake camera take one after another."""
PERIOD = 1 / 60


def looked(meanwhile: str) -> FakeRun:
    """A look, before which the arm does something while the camera turns its lenses, is aimed and focused."""
    run = fake_run(f"LENS 25\nAIM PUMP\n{meanwhile}LOOK WIDE", parts={"PUMP": part()})
    run.cell.camera.pictures = [np.indices((ROWS, COLUMNS)).sum(axis=0).astype(np.uint8) % 16]
    return run.go()


def waited(run: FakeRun) -> list[tuple[str, float]]:
    return [(event.action, event.seconds) for event in run.events if isinstance(event, CameraBusy)]


def test_a_picture_waits_for_the_whole_mechanism_if_the_arm_has_nothing_else_to_do() -> None:
    run = looked("")
    wait, digitise = waited(run)
    assert wait == ("wait", pytest.approx(MECHANISM))
    assert digitise[0] == "digitise"
    assert run.cell.arm.braked


def test_what_the_arm_does_meanwhile_is_not_waited_for_again() -> None:
    idle, busy = looked(""), looked("CHANGE [0 0 1] 1\n")
    (alone, *_), (beside, *_) = waited(idle), waited(busy)
    assert 0 < beside[1] < alone[1] - 0.3
    assert taken(busy) == pytest.approx(taken(idle), abs=1.1 * PERIOD)


def taken(run: FakeRun) -> float:
    """When the picture was there, s."""
    return next(event.time for event in run.events if isinstance(event, PictureTaken))


def test_a_picture_shows_the_moment_in_which_it_is_there(monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[float] = []
    digitise = FakeCamera.digitise

    def noting(camera: FakeCamera, *, hold_target: bool = False) -> Picture:
        shown.append(run.cell.clock.now)
        return digitise(camera, hold_target=hold_target)

    monkeypatch.setattr(FakeCamera, "digitise", noting)
    run = fake_run("LOOK A\nLOOK B")
    run.go()
    assert shown == [event.time for event in run.events if isinstance(event, PictureTaken)]
    assert shown[1] - shown[0] == pytest.approx(DIGITISE)


def test_no_picture_is_waited_for_once_the_camera_is_ready() -> None:
    run = looked("CHANGE [0 0 1] 1\nCHANGE [0 0 -1] 1\n" * 4)
    assert [action for action, _ in waited(run)] == ["digitise"]


def test_a_mechanism_does_one_thing_after_another() -> None:
    run = looked("")
    begun = [event for event in run.events if isinstance(event, CameraStarted)]
    assert [event.action for event in begun] == ["lens", "aim", "focus"]
    assert len({event.time for event in begun}) == 1


EVENTS: list[AnyEvent] = [
    CameraStarted(time=10.0, action="lens", seconds=20.0),
    CameraStarted(time=12.0, action="aim", seconds=5.0),
    CameraBusy(time=35.0, action="wait", seconds=15.0),
    CameraBusy(time=35.5, action="digitise", seconds=0.5),
]


def test_the_time_in_which_arm_and_camera_both_worked_is_what_was_not_waited_for() -> None:
    assert overlapped(EVENTS, 40.0) == pytest.approx(10.0)


def test_what_the_mechanism_has_still_to_do_is_not_counted() -> None:
    assert overlapped(EVENTS[:2], 16.0) == pytest.approx(6.0)
