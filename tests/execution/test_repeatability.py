"""Equal seeds give equal runs, byte for byte, pictures included."""

import pytest
from pump_bench import bench

from handeye.program.events import PartSeen, to_line
from handeye.tasks.water_pump.world.pump_world import PumpWorld

pytestmark = [pytest.mark.slow, pytest.mark.render]

SHORT = """
        LENS    25
        AIM     BASE
        LOOK    WIDE
        GENERAL BASE WIDE
        OPEN    1.775
        MOVE    A
        STOP    [0 0 -30]
        CHANGE  [0 0 -1] 1.5
        CENTER  .5
"""


def trace(seed: int) -> bytes:
    """Every event of a short run that looks, moves and feels."""
    run = bench(SHORT, world=PumpWorld.sample(seed), camera="auto").go()
    assert run.all(PartSeen)
    return b"".join(to_line(event) for event in run.events)


@pytest.fixture(scope="module")
def first() -> bytes:
    return trace(2)


def test_one_seed_gives_the_same_trace_twice(first: bytes) -> None:
    assert trace(2) == first


def test_another_seed_gives_another_trace(first: bytes) -> None:
    assert trace(4) != first
