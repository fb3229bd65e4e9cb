"""What of a cell is written to a trace: frames of bodies that move, appear, and are not there any more."""

import numpy as np

from handeye.trace.moved_frames import MOVED, PUT_AWAY, MovedFrames


def test_a_screw_that_was_driven_out_is_put_away_and_comes_back_when_it_is_driven_again() -> None:
    base, carrier = 0, 1
    poses = np.tile(np.float32([0, 0, 0, 1, 0, 0, 0]), (5, 2, 1))
    poses[:, carrier, 2] = 0.5
    poses[3:, :, 2] += 0.25  # the base is carried off, and the body of the screw in its thread with it
    there = np.array([[True, driven] for driven in (False, True, False, False, True)])
    heights = [
        {number: pose[2] for number, pose in zip(*moved, strict=True)}
        for moved in MovedFrames(2).to_write(poses, there)
    ]
    away = 2 * PUT_AWAY
    assert heights == [{base: 0}, {carrier: 0.5}, {carrier: away}, {base: 0.25}, {carrier: 0.75}]


def test_periods_that_are_compared_together_give_what_they_give_one_by_one() -> None:
    rng = np.random.default_rng(1973)
    strides = MOVED * np.array([0, 0.02, 0.3, 0.9, 3.0])  # from a body at rest to one that always moves
    steps = rng.normal(0, 1, (200, 5, 7)) * strides[:, None]
    poses = np.cumsum(steps, axis=0, dtype=np.float32)
    there = np.repeat(rng.random((20, 5)) < 0.8, 10, axis=0)
    poses[np.repeat(rng.random((20, 5)) < 0.2, 10, axis=0), 2] = 1.5 * PUT_AWAY
    single, together = MovedFrames(5), MovedFrames(5)
    one_by_one = [
        moved
        for pose, shown in zip(poses, there, strict=True)
        for moved in single.to_write(pose[None].copy(), shown[None])
    ]
    assert together.to_write(poses, there) == one_by_one
    assert np.array_equal(together.written, single.written)
    assert 0 < sum(len(numbers) for numbers, _ in one_by_one) < there.size
