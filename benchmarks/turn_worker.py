"""Advances a run from a checkpoint, one stage for each line on standard input, and prints what each stage cost.

Run as a file, not as a module, with the root of a checkout as PYTHONPATH: `turns.py` runs it in two checkouts.
"""

import hashlib
import json
import sys
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np

from benchmarks.tape import physics_through
from handeye.core.packed import encoded
from handeye.execution.servo import ServoPeriod
from handeye.runs.advance import AfterStage, advance
from handeye.runs.checkpoint_file import read_checkpoint
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner


class _Digest(Observer):
    """A digest of every servo period: readings, torques, sensed force, and the true state of the cell."""

    def __init__(self, runner: Runner) -> None:
        self.hash, self._data = hashlib.sha256(), runner.arm_cell.truth.data

    def tick(self, period: ServoPeriod) -> None:
        sensed = period.sensed
        for values in (sensed.q, sensed.qd, period.effort, period.wrench, self._data.qpos, self._data.qvel):
            self.hash.update(b"" if values is None else np.asarray(values).tobytes())


def serve(checkpoint: Path) -> None:
    """Advance the run by a stage for each line, until it ends."""
    spent = [0.0]
    with physics_through(partial(_timed, spent)):
        runner = Runner(read_checkpoint(checkpoint), observers=lambda runner: [_Digest(runner)])
        (digest,) = runner.observers
        assert isinstance(digest, _Digest)
        for _ in sys.stdin:
            if runner.next is None or runner.ended:
                break
            name = runner.listing.stages[runner.next.stage]
            spent[0], began, at = 0.0, time.process_time(), runner.time
            pause = advance(runner, [AfterStage(stage=runner.next.stage, name=name)])
            cpu_s = time.process_time() - began
            kept = runner.history[-1]
            state = (
                digest.hash.hexdigest().encode(),
                encoded(kept.state),
                encoded(kept.cell),
                encoded(tuple(runner.events)),
            )
            told = {
                "stage": name,
                "cpu_s": cpu_s,
                "physics_cpu_s": spent[0],
                "simulated_s": runner.time - at,
                "digest": hashlib.sha256(b"".join(state)).hexdigest()[:16],
                "pause": pause.kind if pause.kind not in ("break", "end") else "",
            }
            sys.stdout.write(f"{json.dumps(told)}\n")
            sys.stdout.flush()
            if pause.kind != "break":
                break


def _timed(spent: list[float], call: Callable[..., Any]) -> Callable[..., Any]:
    """Return the same function, which adds its CPU seconds to `spent`."""

    def through(*arguments: Any) -> Any:
        began = time.process_time()
        result = call(*arguments)
        spent[0] += time.process_time() - began
        return result

    return through


if __name__ == "__main__":
    serve(Path(sys.argv[1]))
