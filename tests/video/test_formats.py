"""The files of a video: what is in them, and which are not made."""

import re
from collections.abc import Callable, Iterator
from pathlib import Path

import cv2
import numpy as np
import pytest

from handeye.cell.photograph import Photograph
from handeye.core.errors import InvalidInput
from handeye.video.formats import RATE, format_of, settled, webm, webp

LEVELS = (40, 90, 140, 190)


def frames() -> Iterator[Photograph]:
    """Four frames, each of one red."""
    for level in LEVELS:
        frame = np.zeros((48, 64, 3), dtype=np.uint8)
        frame[..., 0] = level
        yield frame


def test_a_webp_shows_each_frame_and_the_last_one_longer() -> None:
    _, animation = cv2.imdecodeanimation(np.frombuffer(webp(frames(), held=6), np.uint8))
    durations = np.array(animation.durations)
    assert durations.tolist() == [83, 84, 83, 583]
    assert [int(frame[..., 2].mean()) for frame in animation.frames] == pytest.approx(LEVELS, abs=3)
    assert animation.loop_count == 0


def test_what_changes_slowly_is_seen_to_change() -> None:
    """Beside something that moves, so that there is a reason for a new frame at all."""
    slow = [np.full((48, 64, 3), level, dtype=np.uint8) for level in range(60, 180, 2)]
    for number, frame in enumerate(slow):
        frame[20:28, number : number + 4] = 255
    _, animation = cv2.imdecodeanimation(np.frombuffer(webp(iter(slow), held=0), np.uint8))
    last = animation.frames[-1][..., :3].astype(int)
    assert np.abs(last - slow[-1])[:16].mean() < 8


def test_what_hardly_changes_is_left_as_it_is() -> None:
    still = np.full((20, 20, 3), 100, dtype=np.uint8)
    noisy, moved = still + np.uint8(4), still.copy()
    moved[9, 17] = 200
    shown = list(settled(iter([still, noisy, moved])))
    assert [np.array_equal(frame, still) for frame in shown[:2]] == [True, True]
    assert np.array_equal(shown[2], moved)


def test_a_webm_has_a_frame_for_each_period(tmp_path: Path) -> None:
    (tmp_path / "it.webm").write_bytes(webm(frames(), held=2))
    video = cv2.VideoCapture(str(tmp_path / "it.webm"))
    assert video.get(cv2.CAP_PROP_FPS) == RATE
    levels = []
    while (read := video.read())[0]:
        levels.append(int(read[1][..., 2].mean()))
    assert levels == pytest.approx([*LEVELS, LEVELS[-1], LEVELS[-1]], abs=4)


@pytest.mark.parametrize("encode", [webp, webm])
def test_the_same_frames_give_the_same_file(encode: Callable[..., bytes]) -> None:
    assert encode(frames(), 1) == encode(frames(), 1)


def test_opencv_says_nothing(capfd: pytest.CaptureFixture[str]) -> None:
    webm(frames(), 0)
    assert capfd.readouterr() == ("", "")


def test_a_file_is_known_by_how_it_begins() -> None:
    for name in ("it.webp", "it.WEBM"):
        form = format_of(Path(name))
        assert re.match(form.kind.begins, form.encode(frames(), 0))


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        (
            "it.gif",
            "it.gif: a GIF would be seven times as large as a WebP picture, with only 256 colours; use .webp or "
            ".webm or .mp4",
        ),
        (
            "it.APNG",
            "it.APNG: an animated PNG would be twenty times as large as a WebP picture; use .webp or .webm or .mp4",
        ),
        ("it.mkv", "it.mkv: the name of a video must end in .webp or .webm or .mp4"),
        ("it", "it: the name of a video must end in .webp or .webm or .mp4"),
    ],
)
def test_other_files_are_refused_with_the_reason(name: str, sentence: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        format_of(Path(name))
    assert str(refused.value) == sentence


def test_a_webm_has_even_sides() -> None:
    format_of(Path("it.webp")).check(10, 65, 48)
    with pytest.raises(
        InvalidInput, match=r"^a WebM video of 65 x 48 cannot be made; width and height must be even$"
    ):
        format_of(Path("it.webm")).check(10, 65, 48)


def test_a_webp_that_is_too_large_for_memory_is_refused() -> None:
    format_of(Path("it.webm")).check(168, 2048, 2048)
    with pytest.raises(InvalidInput, match=r"^168 frames of 2048 x 2048 are too many for a WebP picture, "):
        format_of(Path("it.webp")).check(168, 2048, 2048)
