"""Makes the film of the palletiser for docs/trig.md anew: a job is carried out, undone, and drawn.

python docs/make_palletiser_film.py
"""

import sys
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import cv2
import mujoco
import numpy as np

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

from handeye.cell.photograph import Photograph, Photographer  # noqa: E402
from handeye.report.taught_job import ALL  # noqa: E402
from handeye.tasks.blocks.jobs import PalletJob  # noqa: E402
from handeye.tasks.blocks.world import BlocksWorld  # noqa: E402
from handeye.video.captions import Caption, captioned  # noqa: E402
from handeye.video.frames import RATE  # noqa: E402
from handeye.video.webp import webp  # noqa: E402

FILM: Final = ROOT / "docs" / "pictures" / "palletiser.webp"
SEED, BLOCKS, SPEED = 0, 9, 24
WIDTH, HEIGHT, FINER = 400, 300, 2
HELD: Final = 2 * RATE


@dataclass(frozen=True, slots=True)
class Moment:
    """One frame, before it is drawn."""

    qpos: np.ndarray
    time: float
    step: str
    back: bool


def filmed(job: PalletJob) -> list[Moment]:
    """A job carried out and undone, with a moment for each frame."""
    moments: list[Moment] = []
    bench, program = job._table.bench, job.session.program
    began, every, back = bench.now, round(1000 * SPEED / RATE), False
    steps = 0

    def look() -> None:
        nonlocal steps
        if steps % every == 0:
            active = program.active
            step = active.name or active.position or active.type
            moments.append(Moment(bench.data.qpos.copy(), bench.now - began, step, back))
        steps += 1

    bench.before_step.append(look)
    forward = job.session.runner.run()
    back = True
    undone = job.session.runner.back(ALL)
    if (forward.end, undone.end) != ("none", "beginning"):
        raise SystemExit(f"the job has not come to its end: {forward}, {undone}")
    return moments


def drawn(job: PalletJob, moments: list[Moment]) -> Iterator[Photograph]:
    """The frames."""
    model = job._table.bench.model
    data = mujoco.MjData(model)
    photographer = Photographer(model, width=FINER * WIDTH, height=FINER * HEIGHT)
    for moment in moments:
        data.qpos[:] = moment.qpos
        mujoco.mj_forward(model, data)
        fine = photographer.take(model, data, "people")
        small = np.asarray(cv2.resize(fine, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA), dtype=np.uint8)
        words = f"{'backwards' if moment.back else 'forwards'}: {moment.step}"
        clock = f"{moment.time // 60:.0f}:{moment.time % 60:02.0f}"
        caption = Caption(words=words, clock=clock, stages=2, begun=1 + moment.back, stopped=False)
        yield captioned(small, caption, None)


def main() -> None:
    """Teach, run, undo, draw, write."""
    job = PalletJob(BlocksWorld(SEED), BLOCKS)
    job.teach(lambda: False)
    moments = filmed(job)
    FILM.write_bytes(webp(drawn(job, moments), HELD))


if __name__ == "__main__":
    main()
