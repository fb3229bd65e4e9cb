"""Pictures of the camera stand in the page as they were, pixel by pixel."""

import cv2
import numpy as np
import pytest

from handeye.report.page.seen import picture_png


@pytest.mark.parametrize("columns", [6, 333])
def test_a_picture_file_holds_every_level(columns: int) -> None:
    picture = np.random.default_rng(1973).integers(0, 16, (256, columns), dtype=np.uint8)
    shown = cv2.imdecode(np.frombuffer(picture_png(picture), np.uint8), cv2.IMREAD_GRAYSCALE)
    assert np.array_equal(shown, picture * 17)
