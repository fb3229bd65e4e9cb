"""A motion of no length: the checker refuses it, but a plan file may have it."""

from fake_runs import fake_run

from handeye.execution.motion_actions import turn
from handeye.program.motion_operations import Turn


def test_a_turn_by_no_angle_is_no_motion() -> None:
    run = fake_run("MOVE T")
    here = run.executor.run.drive.state.q.copy()
    assert turn(run.executor.run, Turn(centre="T", angle=0.0)) is None
    assert (run.executor.run.drive.state.q == here).all()
