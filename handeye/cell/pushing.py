"""Somebody who pushes the hand of the simulated arm: an act of the experimenter, which no program can do."""

from collections.abc import Iterator
from contextlib import contextmanager

from handeye.cell.simulated import SimulatedCell
from handeye.core.record import Vector3


@contextmanager
def pushed(cell: SimulatedCell, force: Vector3) -> Iterator[None]:
    """While this lasts, the hand is pushed with a force (N, table coordinates)."""
    applied, body = cell.truth.data.xfrc_applied, cell.arm.last_link
    applied[body, :3] = force
    try:
        yield
    finally:
        applied[body] = 0.0
