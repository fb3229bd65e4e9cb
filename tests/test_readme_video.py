"""The video that leads the README: long enough, small enough, and three close-ups to be told apart."""

from dataclasses import dataclass
from functools import cache
from itertools import pairwise
from pathlib import Path

import cv2
import numpy as np
import pytest
from numpy.typing import NDArray

from handeye.video.captions import DONE

ROOT = Path(__file__).parent.parent
CLOSE_UPS = 3
VIDEO = ROOT / "docs" / "pictures" / "assembly.webp"

pytestmark = pytest.mark.slow


@dataclass(frozen=True)
class Shown:
    """A frame as long as it stands."""

    frame: NDArray[np.uint8]
    seconds: float

    @property
    def close_up(self) -> int:
        """How many pieces of the bar on its lower edge are lit."""
        width = self.frame.shape[1]
        middles = [(2 * number + 1) * width // (2 * CLOSE_UPS) for number in range(CLOSE_UPS)]
        far = np.abs(self.frame[-3, middles, ::-1].astype(int) - DONE).max(axis=1)
        return int((far < 40).sum())

    @property
    def scene(self) -> NDArray[np.uint8]:
        """The frame without what is said over it."""
        height, width = self.frame.shape[:2]
        return self.frame[height // 5 : height * 4 // 5, : width * 3 // 5]


@cache
def shown() -> tuple[Shown, ...]:
    done, animation = cv2.imreadanimation(str(VIDEO))
    assert done
    return tuple(
        Shown(frame=frame[..., :3], seconds=milliseconds / 1000)
        for frame, milliseconds in zip(animation.frames, np.array(animation.durations), strict=True)
    )


def test_it_is_the_picture_that_leads_the_readme() -> None:
    first = (ROOT / "README.md").read_text(encoding="utf-8").partition("](docs/pictures/")[2]
    assert first.startswith("assembly.webp)")


def test_it_is_long_enough_and_small_enough() -> None:
    assert sum(frame.seconds for frame in shown()) >= 12
    assert VIDEO.stat().st_size < 1.5e6


def test_the_three_close_ups_come_in_order_and_each_stands_long_enough_to_be_read() -> None:
    numbers = [frame.close_up for frame in shown()]
    assert numbers == sorted(numbers)
    seconds = np.zeros(CLOSE_UPS + 1)
    for frame in shown():
        seconds[frame.close_up] += frame.seconds
    assert seconds[0] == 0
    assert seconds[1:].min() > 3


def scenes() -> list[list[NDArray[np.int_]]]:
    """The frames of each close-up."""
    return [
        [frame.scene.astype(int) for frame in shown() if frame.close_up == number]
        for number in range(1, CLOSE_UPS + 1)
    ]


def test_no_two_close_ups_show_the_same() -> None:
    middles = [frames[len(frames) // 2] for frames in scenes()]
    assert min(np.abs(one - other).mean() for one, other in pairwise(middles)) > 5


def test_something_moves_in_every_close_up() -> None:
    for frames in scenes():
        assert max(np.abs(one - other).mean() for one, other in pairwise(frames)) > 2
