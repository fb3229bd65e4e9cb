"""Uses handeye with the libraries that learners bring: plays an episode, and reads a data set back.

`.ci/neighbours` installs everything and runs this file: python neighbours.py LIBRARY ...
"""

import sys
from importlib import import_module
from importlib.metadata import version
from pathlib import Path

import gymnasium
import numpy as np

import handeye
import handeye.env
from handeye.datasets.frames import NO_PICTURE, RATE, frames_of
from handeye.datasets.lerobot import PICTURE, WIDTH, shown, write_dataset
from handeye.env.environment import AssemblyEnv
from handeye.env.evaluation import play
from handeye.env.policies import policy_maker
from handeye.ports.camera import ROWS

LOOK = "LENS 25\nLOOK WIDE\nOPEN 1\n"


def play_an_episode() -> None:
    """Let the scripted policy insert a pin, through Gymnasium's and our own interface."""
    env = gymnasium.make("handeye/Pin-v0")
    env.reset(seed=1)
    assert env.action_space.shape
    seen, *_ = env.step(np.zeros(env.action_space.shape))
    assert env.observation_space.contains(seen)
    found = play(
        AssemblyEnv("handeye/Pin-v0", action="torques"), policy_maker("scripted", "handeye/Pin-v0"), seed=1
    )
    assert found.referee["outcome"] == "right", found


def read_a_data_set_back(folder: Path) -> str:
    """Write two runs as a data set, read every frame back with LeRobot, and return a sentence about it."""
    runs = [
        handeye.assemble(seed, script=LOOK, camera="ray", out=folder.with_name("runs") / f"{seed}")
        for seed in (3, 4)
    ]
    written = write_dataset(folder, [folder.with_name("runs")])
    from lerobot.datasets.lerobot_dataset import LeRobotDataset

    back = LeRobotDataset(f"handeye/{folder.name}", root=folder, video_backend="pyav")
    assert (back.num_episodes, back.num_frames, back.fps) == (2, written.frames, RATE), written
    numbers = back.hf_dataset.remove_columns(back.meta.image_keys).with_format("numpy")
    begin, pictures = 0, 0
    for run in runs:
        frames = frames_of(run.trace)
        rows = numbers[begin : begin + len(frames)]
        for name in ("state", "state_mean", "rate", "torque", "force", "force_mean"):
            np.testing.assert_allclose(rows[f"observation.{name}"], getattr(frames, name), rtol=1e-6)
        np.testing.assert_allclose(rows["action"], frames.action, rtol=1e-6)
        assert (*rows["annotation.stage"],) == frames.stage
        assert (*rows["annotation.instruction"],) == frames.instruction
        assert rows["next.done"].ravel().tolist() == [False] * (len(frames) - 1) + [True]
        assert not rows["next.success"].any()  # nothing was assembled
        for number in sorted(set(frames.picture.tolist())):
            frame = begin + int(np.flatnonzero(frames.picture == number)[-1])
            sent = np.zeros((ROWS, WIDTH, 3), np.uint8)
            if number != NO_PICTURE:
                sent = shown(run.trace.pictures[number].picture)
            np.testing.assert_array_equal(
                np.rint(255 * back[frame][PICTURE].numpy()).transpose(1, 2, 0), sent
            )
            pictures += number != NO_PICTURE
        begin += len(frames)
    assert (begin, pictures) == (back.num_frames, 2)
    return f"{begin} frames and {pictures} television pictures were read back without loss"


def main(libraries: list[str]) -> None:
    """Check handeye with these libraries, and print their versions."""
    for name in libraries:
        import_module(name)
    play_an_episode()
    if "lerobot" in libraries:
        print(read_a_data_set_back(Path("data")))
    print(
        ", ".join(
            f"{name} {version(name)}" for name in ("mujoco", "numpy", "opencv-python-headless", *libraries)
        )
    )


if __name__ == "__main__":
    main(sys.argv[1:])
