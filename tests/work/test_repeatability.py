"""Equal seeds give equal runs, byte for byte, pictures included."""

import pytest
from bench import bench, stage

from handeye.cell.imperfection import World
from handeye.work.events import PartSeen, to_line

pytestmark = [pytest.mark.slow, pytest.mark.render]

SHORT = stage("find the base") + "\nOPEN 1.775\nMOVE A\nCENTER .5\nSAVE DA\n"


def trace(seed: int) -> bytes:
    """Every event of a short run that looks, moves and feels."""
    run = bench(SHORT, world=World.sample(seed), camera="auto").go()
    assert run.all(PartSeen)
    return b"".join(to_line(event) for event in run.events)


def test_one_seed_gives_the_same_trace_twice() -> None:
    assert trace(2) == trace(2)


def test_another_seed_gives_another_trace() -> None:
    assert trace(2) != trace(4)
