"""Code of the caller commands the arm, servo period by servo period: recorded, repeatable, refused if it is wrong."""

import re
from pathlib import Path

import numpy as np
import pytest

import handeye
from handeye.arm import gravity
from handeye.core.errors import InvalidInput, Refused
from handeye.ports.workcell import Sensed
from handeye.program.events import PeriodsCommanded
from handeye.runs.verify import difference

SCRIPT = "OPEN 1\nOPEN 2\n"
HELD = np.array([400.0, 400.0, 400.0, 20.0, 20.0, 10.0])  # stiffness of the joints, N m/rad and N/m
TURNED = 0.1  # rad, of joint 6


class Turn:
    """Turns the last joint in .4 s, with torques from the readings only, and closes the fingers."""

    def __init__(self, start: handeye.State) -> None:
        self.start, self.seen = start, list[Sensed]()

    def __call__(self, seen: Sensed) -> handeye.Command | None:
        self.seen.append(seen)
        gone = seen.time - self.start.time
        goal = self.start.joints + np.array([0, 0, 0, 0, 0, TURNED * min(1.0, gone / 0.3)])
        torque = gravity(seen.q) + HELD * (goal - seen.q) - HELD / 8 * seen.qd
        return None if gone > 0.4 else handeye.Command(torque=torque, gap=0.01)


def other(seen: Sensed) -> handeye.Command:
    """Never ends."""
    return handeye.Command()


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> handeye.Run:
    """A run with a controlled motion between its two steps, and a brake of two periods after them."""
    out = tmp_path_factory.mktemp("controlled") / "run"
    with handeye.begin(SCRIPT, task="insertion", camera="ray", seed=3, out=out) as run:
        state = run.step()
        turn = Turn(state)
        run.turned = (turn, state, run.control(turn))  # type: ignore[attr-defined]
        run.until()
        run.control(other, seconds=2 / 60)
    return run


@pytest.mark.slow
def test_a_controller_moves_the_arm_by_what_it_reads_in_every_servo_period(run: handeye.Run) -> None:
    turn, before, after = run.turned  # type: ignore[attr-defined]
    times = np.array([seen.time for seen in turn.seen])
    assert np.diff(times) == pytest.approx(1 / 60)
    assert after.joints - before.joints == pytest.approx([0, 0, 0, 0, 0, TURNED], abs=0.03)
    assert after.gap == pytest.approx(0.01, abs=0.001)
    assert after.why == f"the controller {__name__}.Turn ended after {len(times[1:]) / 60:.2f} s"


@pytest.mark.slow
def test_a_controlled_run_is_repeated_byte_for_byte_from_its_trace(run: handeye.Run, tmp_path: Path) -> None:
    first, last = (event for event in run.events if isinstance(event, PeriodsCommanded))
    assert (len(first.periods), len(last.periods)) == (24, 2)
    assert difference(run.trace, tmp_path / "again") is None
    assert [said.partition(" s ")[2] for said in run.result.interventions] == [
        f"the controller {__name__}.Turn commanded 24 servo periods",
        f"the controller {__name__}.other commanded 2 servo periods",
    ]


@pytest.fixture(scope="module")
def open_run() -> handeye.Run:
    """A run that has done a step."""
    run = handeye.begin(SCRIPT, task="insertion", camera="ray")
    run.step()
    return run


def failing(seen: Sensed) -> handeye.Command:
    """Fails in the middle."""
    if seen.time > 1.0:
        raise ZeroDivisionError
    return handeye.Command(torque=gravity(seen.q) + np.array([0, 0, 0, 0, 0, 3]))


@pytest.mark.slow
@pytest.mark.parametrize(
    ("controller", "seconds", "sentence"),
    [
        (3, 1.0, "a controller must be a function that receives the readings, not 3"),
        (other, 0.0, "`seconds` must be a number from one servo period (0.0167 s) to 3600 s, not 0.0"),
        (lambda _: 3, 1.0, "must return a handeye.Command or None, not 3"),
        (lambda _: handeye.Command(torque=[1, 2]), 1.0, "must give 6 finite torques, not [1, 2]"),
        (lambda _: handeye.Command(torque=[np.nan] * 6), 1.0, "must give 6 finite torques, not [nan, "),
        (lambda _: handeye.Command(gap="wide"), 1.0, "must give a finite number as `gap`, not 'wide'"),
    ],
)
def test_a_controller_that_is_no_use_is_refused_and_nothing_has_moved(
    open_run: handeye.Run, controller: object, seconds: float, sentence: str
) -> None:
    before = open_run.state
    with pytest.raises(InvalidInput, match=re.escape(sentence)):
        open_run.control(controller, seconds=seconds)  # type: ignore[arg-type]
    assert np.array_equal(open_run.state.joints, before.joints)


@pytest.mark.slow
def test_a_controller_that_fails_leaves_the_run_as_it_was(open_run: handeye.Run) -> None:
    before = open_run.state
    with pytest.raises(ZeroDivisionError):
        open_run.control(failing)
    assert (open_run.state.time, open_run.state.joints.tolist()) == (before.time, before.joints.tolist())


@pytest.mark.slow
def test_the_arm_does_not_undo_what_it_did_before_it_was_controlled() -> None:
    run = handeye.begin(SCRIPT, task="insertion", camera="ray")
    run.step()
    run.control(other, seconds=1 / 60)
    with pytest.raises(Refused, match=r"^1 step cannot be undone: none has been executed$"):
        run.undo()


@pytest.mark.slow
def test_the_panic_button_stops_a_controller() -> None:
    pressed = False
    run = handeye.begin(SCRIPT, task="insertion", camera="ray", halt=lambda: pressed)
    before, pressed = run.state.time, True
    assert (run.control(other).why, run.state.time) == (
        f"the panic button stopped the controller {__name__}.other; the run is back in its state before the control",
        before,
    )
