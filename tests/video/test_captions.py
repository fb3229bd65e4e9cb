"""Captions tell the stage without cutting a word, whatever the stage is called and however small the frame is."""

from dataclasses import replace

import numpy as np
import pytest

from handeye.cell.photograph import Photograph
from handeye.video.captions import DONE, STOPPED, TO_COME, Caption, captioned

CAPTION = Caption(words="4  insert the aligning pins", clock="2:04", stages=11, begun=4, stopped=False)


def frame(width: int = 480, height: int = 360) -> Photograph:
    return np.full((height, width, 3), 128, dtype=np.uint8)


def pieces(said: Photograph, stages: int) -> list[list[int]]:
    """The colour of each piece of the bar."""
    width = said.shape[1]
    return [said[-2, (2 * number + 1) * width // (2 * stages)].tolist() for number in range(stages)]


def written(said: Photograph) -> tuple[int, int]:
    """From which column to which there is white ink."""
    columns = np.flatnonzero((said[:-8] > 200).all(axis=2).any(axis=0))
    return int(columns[0]), int(columns[-1])


def test_the_bar_has_a_piece_for_each_stage() -> None:
    done, to_come = DONE.tolist(), TO_COME.tolist()
    assert pieces(captioned(frame(), CAPTION, None), 11) == [done] * 4 + [to_come] * 7


def test_a_stage_that_was_stopped_is_red() -> None:
    said = captioned(frame(), replace(CAPTION, stopped=True), None)
    assert pieces(said, 11)[2:5] == [DONE.tolist(), STOPPED.tolist(), TO_COME.tolist()]


@pytest.mark.parametrize("width", [480, 200])
@pytest.mark.parametrize(
    "words", ["1  a", "7  " + "the longest name of a stage " * 4, "2  </script><img>", ""]
)
def test_words_stay_clear_of_the_edge_and_of_the_clock(words: str, width: int) -> None:
    clock = captioned(frame(width), replace(CAPTION, words=""), None)
    both = captioned(frame(width), replace(CAPTION, words=words), None)
    columns = np.flatnonzero((both != clock).any(axis=(0, 2)))
    first, last = written(clock)
    assert last < width - 8
    assert not words or 8 < columns.min() <= columns.max() < first


def test_a_picture_stands_in_the_corner_with_its_shape() -> None:
    said = captioned(frame(), CAPTION, np.zeros((256, 333, 3), dtype=np.uint8))
    rows, columns = np.nonzero((said[:200] == 0).all(axis=2))
    assert np.ptp(columns) / np.ptp(rows) == pytest.approx(333 / 256, rel=0.02)
    assert (columns.min() > 240, rows.max() < 180) == (True, True)


@pytest.mark.parametrize("size", [(8, 8), (8, 2048), (2048, 8), (64, 48)])
def test_any_frame_can_be_captioned(size: tuple[int, int]) -> None:
    said = captioned(frame(*size), CAPTION, np.zeros((256, 333, 3), dtype=np.uint8))
    assert said.shape == (size[1], size[0], 3)


def test_the_frame_itself_is_left_as_it_was() -> None:
    drawn = frame()
    captioned(drawn, CAPTION, np.zeros((256, 333, 3), dtype=np.uint8))
    assert (drawn == 128).all()
