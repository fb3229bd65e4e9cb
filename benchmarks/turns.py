"""Runs the same stages in two checkouts, a stage each in turn, and compares their cost and their bytes.

Times of this computer vary by tens of percent with whatever else it does. Ratios of stages that ran one right after
the other vary by a few.
"""

import json
import subprocess
import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

_WORKER: Final = Path(__file__).with_name("turn_worker.py")


@dataclass(frozen=True, slots=True, kw_only=True)
class StageCost:
    """One stage of a run in one checkout."""

    stage: str
    cpu_s: float
    physics_cpu_s: float
    simulated_s: float
    digest: str  # of all servo periods so far, of events, and of the state at the end
    pause: str  # why the run ended early; empty if it did not


def pairs(
    before: Path, after: Path, checkpoint: Path, stages: int | None = None
) -> Iterator[tuple[StageCost, StageCost]]:
    """Yield the costs of each stage in two checkouts, from a checkpoint on, until either run ends or `stages` stages
    are done. Each stage runs in both checkouts, one after the other, and the first to run alternates.
    """
    workers = [_started(checkout, checkpoint) for checkout in (before, after)]
    try:
        done = 0
        while done != stages:
            costs = [_next(worker) for worker in workers[:: 1 if done % 2 == 0 else -1]]
            if done % 2:
                costs.reverse()
            first, second = costs
            if first is None or second is None:
                return
            yield first, second
            done += 1
    finally:
        for worker in workers:
            worker.kill()
            worker.wait()


def _started(checkout: Path, checkpoint: Path) -> subprocess.Popen[str]:
    own = checkout / ".venv" / "bin" / "python"
    python = str(own) if own.exists() else sys.executable
    return subprocess.Popen(  # noqa: S603 - the developer names the checkouts
        [python, "-P", str(_WORKER), str(checkpoint.resolve())],
        cwd=checkout,
        env={"PATH": "/usr/bin:/bin", "PYTHONPATH": str(checkout.resolve())},
        stdin=subprocess.PIPE,
        stdout=subprocess.PIPE,
        text=True,
    )


def _next(worker: "subprocess.Popen[str]") -> StageCost | None:
    assert worker.stdin is not None
    assert worker.stdout is not None
    try:
        worker.stdin.write("\n")
        worker.stdin.flush()
    except BrokenPipeError:
        return None
    line = worker.stdout.readline()
    return StageCost(**json.loads(line)) if line else None


def lines(costs: Sequence[tuple[StageCost, StageCost]]) -> Iterator[str]:
    """Yield a line for each stage, and one for all: the CPU seconds per simulated second in the second checkout,
    divided by those in the first. There is one ratio each for the work, its physics, and the rest.
    """
    yield f"{'stage':36} {'before':>7} {'after':>7}  {'work':>5} {'physics':>7} {'rest':>5}  bytes"
    for first, second in costs:
        same = "same" if first.digest == second.digest else "differ"
        ends = "; ".join(filter(None, (first.pause, second.pause)))
        yield _line(first.stage, [(first, second)], f"{same} {ends}")
    yield _line("all", costs, "")


def _line(name: str, costs: Sequence[tuple[StageCost, StageCost]], said: str) -> str:
    work, physics = (
        [sum(getattr(pair[i], what) for pair in costs) for i in (0, 1)] for what in ("cpu_s", "physics_cpu_s")
    )
    simulated = [sum(pair[i].simulated_s for pair in costs) for i in (0, 1)]
    rest = [a - b for a, b in zip(work, physics, strict=True)]
    longer = simulated[0] / simulated[1]
    ratios = [b / a * longer if a else float("nan") for a, b in (work, physics, rest)]
    columns = f"{work[0]:7.2f} {work[1]:7.2f}  {ratios[0]:5.3f} {ratios[1]:7.3f} {ratios[2]:5.3f}"
    return f"{name:36} {columns}  {said}".rstrip()
