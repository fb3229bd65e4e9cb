"""A video where there is OpenGL: the cell is to be seen in it, and the same trace gives the same bytes."""

from pathlib import Path

import cv2
import numpy as np
import pytest
from short_runs import begin, through

import handeye
from handeye.cell.opengl import context
from handeye.core.errors import InvalidInput
from handeye.runs.folder import TRACE, open_new
from handeye.runs.runner import Runner

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> handeye.Trace:
    """A run that opens the hand."""
    try:
        context()
    except InvalidInput as reason:
        pytest.skip(str(reason))
    start, path = begin("OPEN 1\nOPEN 2"), tmp_path_factory.mktemp("drawn") / "run"
    folder = open_new(path, start)
    runner = Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)])
    through(runner).finish()
    folder.close()
    return handeye.open(path / TRACE)


def test_the_cell_is_seen_and_the_eye_goes_round_it(trace: handeye.Trace, tmp_path: Path) -> None:
    trace.video(tmp_path / "it.webp", width=64, height=48, seconds=0.5)
    _, animation = cv2.imreadanimation(str(tmp_path / "it.webp"))
    first, *_, middle, _, _ = (frame.astype(int) for frame in animation.frames)
    assert first.std() > 30
    assert np.abs(first - middle).mean() > 5


@pytest.mark.parametrize("name", ["it.webp", "it.webm"])
def test_the_same_trace_gives_the_same_bytes(trace: handeye.Trace, tmp_path: Path, name: str) -> None:
    written = []
    for _ in range(2):
        trace.video(
            tmp_path / name, width=64, height=48, seconds=0.3, camera="follow", captions=True, overwrite=True
        )
        written.append((tmp_path / name).read_bytes())
    assert written[0] == written[1]
