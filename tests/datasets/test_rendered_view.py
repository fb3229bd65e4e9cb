"""The rendered view of a frame: the state at its moment, drawn only where something has moved."""

from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from handeye.cell.photograph import Photograph
from handeye.datasets import rendered_view as drawing
from handeye.datasets.rendered_view import HEIGHT, WIDTH, rendered_view

MOVES = 0.25  # s: the part moves at this time


@pytest.fixture
def trace() -> Any:
    """A recording from .1 to .4 s, in which a part moves once."""

    def at(time: float) -> SimpleNamespace:
        return SimpleNamespace(time=time, poses={"part": (float(time > MOVES), 0, 0, 1, 0, 0, 0)})

    return SimpleNamespace(scene=None, covers=(0.1, 0.4), at=at)


@pytest.fixture
def drawn(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """The times that are drawn. A drawing is as bright as 100 times its time."""
    times: list[float] = []

    class Photographer:
        def __init__(self, scene: None, *, width: int, height: int, **_: object) -> None:
            self.shape = (height, width, 3)

        def take(self, time: float, camera: str) -> Photograph:
            assert camera == "studio"
            times.append(time)
            return np.full(self.shape, round(100 * time), dtype=np.uint8)

    monkeypatch.setattr(drawing, "Photographer", Photographer)
    monkeypatch.setattr(drawing, "posed", lambda scene, poses, time: (time,))
    return times


def test_a_view_is_drawn_only_when_something_has_moved(trace: Any, drawn: list[float]) -> None:
    views = list(rendered_view(trace, "studio", np.array([0.1, 0.2, 0.3, 0.4])))
    assert drawn == [0.1, 0.3]
    assert [(view.shape, view.max()) for view in views] == [
        ((HEIGHT, WIDTH, 3), level) for level in (10, 10, 30, 30)
    ]


def test_a_moment_outside_the_recording_shows_its_first_or_last_state(trace: Any, drawn: list[float]) -> None:
    views = list(rendered_view(trace, "studio", np.array([0.0, 0.5])))
    assert (len(views), drawn) == (2, [0.1, 0.4])
