"""An image that is encoded once: every file shows the same pixels, and is the same file where that is possible."""

from io import BytesIO
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest
from numpy.typing import NDArray
from PIL import Image

from handeye.core.variation import WorldSpec
from handeye.datasets.encoded_image import EncodedImage
from handeye.datasets.episodes import Episode
from handeye.datasets.frames import Frames
from handeye.datasets.lerobot import PICTURE, features, lerobot_frames, shown

PIXELS = np.arange(4 * 6 * 3, dtype=np.uint8).reshape(4, 6, 3)


def in_file(path: Path | BytesIO) -> NDArray[np.uint8]:
    with Image.open(path) as image:
        return np.asarray(image)


@pytest.fixture
def image() -> EncodedImage:
    return EncodedImage(PIXELS)


def test_every_file_is_the_first_one_and_shows_the_pixels(image: EncodedImage, tmp_path: Path) -> None:
    paths = [tmp_path / f"{number}.png" for number in range(3)]
    for path in paths:
        image.save(path, compress_level=1)
    assert len({path.stat().st_ino for path in paths}) == 1
    np.testing.assert_array_equal(in_file(paths[2]), PIXELS)


def test_if_the_first_file_was_removed_the_next_is_written(image: EncodedImage, tmp_path: Path) -> None:
    image.save(tmp_path / "a.png")
    (tmp_path / "a.png").unlink()
    image.save(tmp_path / "b.png")
    np.testing.assert_array_equal(in_file(tmp_path / "b.png"), PIXELS)


def test_a_file_of_another_image_is_replaced_and_its_links_stay(image: EncodedImage, tmp_path: Path) -> None:
    other = EncodedImage(255 - PIXELS)
    for name in ("a.png", "b.png"):
        other.save(tmp_path / name)
    image.save(tmp_path / "b.png")
    np.testing.assert_array_equal(in_file(tmp_path / "a.png"), 255 - PIXELS)
    np.testing.assert_array_equal(in_file(tmp_path / "b.png"), PIXELS)


def test_a_file_that_cannot_be_written_completely_is_removed(
    image: EncodedImage, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def full(path: Path, data: bytes) -> None:
        with path.open("wb") as file:
            file.write(data[:10])
        raise OSError("no space")

    monkeypatch.setattr(Path, "write_bytes", full)
    with pytest.raises(OSError, match="no space"):
        image.save(tmp_path / "a.png")
    assert [*tmp_path.iterdir()] == []


def test_another_format_is_encoded_as_any_image_is(image: EncodedImage, tmp_path: Path) -> None:
    image.save(tmp_path / "a.bmp")
    assert (tmp_path / "a.bmp").read_bytes().startswith(b"BM")
    np.testing.assert_array_equal(in_file(tmp_path / "a.bmp"), PIXELS)
    stream = BytesIO()
    image.save(stream, "PNG")
    np.testing.assert_array_equal(in_file(stream), PIXELS)


def test_a_frame_shows_the_last_picture_without_loss_and_is_black_before_the_first() -> None:
    levels = np.random.default_rng(0).integers(0, 16, (2, 256, 333)).astype(np.uint8)
    trace: Any = SimpleNamespace(pictures=[SimpleNamespace(picture=each) for each in levels])
    numbers = np.array([-1, 0, 0, 1])
    none = np.zeros((len(numbers), 1))
    frames = Frames(
        times=none[:, 0], state=none, state_mean=none, rate=none, torque=none, force=none, force_mean=none,
        force_share=none[:, 0], picture=numbers, picture_age=none[:, 0], action=none, stage=("",) * 4,
        instruction=("",) * 4,
    )  # fmt: skip
    episode = Episode(
        episode=0, task="assembly", program="", world=WorldSpec(seed=0), outcome="right", stopped_at=None, message="",
        wrong=(), interventions=(), renderer="", versions={},
    )  # fmt: skip
    found = [frame[PICTURE] for frame in lerobot_frames(frames, trace, episode, pictures=True, view=None)]
    assert features(["a"], pictures=True, view=False)[PICTURE]["dtype"] == "image"  # PNG files: without loss
    sent = [np.zeros((256, 334, 3), np.uint8), *(shown(each) for each in levels[[0, 0, 1]])]
    for image, pixels in zip(found, sent, strict=True):
        np.testing.assert_array_equal(np.asarray(image), pixels)
    assert found[1] is found[2]  # so it is encoded once
