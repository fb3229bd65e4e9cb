"""Somebody who pushes the hand of the simulated arm: an act of the experimenter, which no program can do."""

from collections.abc import Iterator
from contextlib import contextmanager
from typing import Final

from handeye.cell.simulated import SimulatedCell

_WRIST: Final = "stanford/link6"


@contextmanager
def pushed(cell: SimulatedCell, force: tuple[float, float, float]) -> Iterator[None]:
    """While this lasts, the hand is pushed with a force (N, table coordinates)."""
    body = cell.truth.model.body(_WRIST).id
    applied = cell.truth.data.xfrc_applied
    applied[body, :3] = force
    try:
        yield
    finally:
        applied[body] = 0.0
