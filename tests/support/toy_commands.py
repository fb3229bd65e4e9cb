"""Commands that the counter machine adds to those of handeye."""

from pathlib import Path

from toy_language import compiled

from handeye.cli.common import Json
from handeye.cli.job import Job, work
from handeye.core.source import read_source
from handeye.core.variation import WorldSpec
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint


def toy(file: Path, /, *, out: Path | None = None, step: bool = False, json: Json = False) -> int:
    """Count with registers, in one task or several."""
    setup = Setup(
        system="toy", plan=compiled(read_source(file)), world=WorldSpec(seed=0), camera="auto", judged=True
    )
    return work(Job(start=Checkpoint(setup=setup), out=out, step=step, json=json, referee=True))
