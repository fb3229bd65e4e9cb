"""Makes a video of a taught job: records the cell while the arm works, and draws the frames at the end."""

from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import cv2
import numpy as np

from handeye.cell.bench import Bench
from handeye.cell.opengl import context
from handeye.cell.photograph import Photograph, Photographer
from handeye.cell.posed import standing
from handeye.core.errors import Refused
from handeye.core.files import check_place, write_over
from handeye.core.pose import Array
from handeye.report.page.figures import clock
from handeye.systems.trig.jobs.benches import TaughtJob
from handeye.video.captions import Caption, captioned
from handeye.video.formats import RATE, format_of

WIDTH, HEIGHT = 400, 300  # points
MAX_SECONDS: Final = 20.0
_VIEW: Final = "people"
_FINER: Final = 2  # drawn points per frame point along a side
_SHADOW: Final = 2048
_EVERY: Final = 0.25  # s of the arm's clock between moments
_HELD: Final = 2 * RATE  # periods of the last frame


@dataclass(frozen=True, slots=True)
class _Moment:
    time: float  # s by the arm's clock
    qpos: Array
    words: str


class JobVideo:
    """Records a job for a video."""

    def __init__(self, path: Path, *, overwrite: bool) -> None:
        """Check that the video can be written."""
        self._path, self._form = path, format_of(path)
        check_place(path, self._form.kind, overwrite=overwrite)
        context()
        self._moments: list[_Moment] = []

    def watch(self, job: TaughtJob) -> None:
        """Start to record. This is called after teaching."""
        bench, program = job.bench, job.session.program

        def look() -> None:
            if not self._moments or bench.now - self._moments[-1].time >= _EVERY:
                active = program.active
                words = active.name or active.position or active.type
                self._moments.append(_Moment(bench.now, bench.data.qpos.copy(), words))

        bench.after_period.append(look)

    def write(self, job: TaughtJob, ended: float | None, told: Callable[[int, int], None]) -> None:
        """Write the video. Either the whole file is written, or nothing. `ended` is the time (s) at which the program
        ended and the reversal began. `told` is called for each frame.
        """
        if not self._moments:
            raise Refused(f"the arm has not moved, so {self._path} was not made")
        most = int(MAX_SECONDS * RATE) - _HELD
        rows = np.unique(np.linspace(0, len(self._moments) - 1, most).round().astype(int))
        shown = [self._moments[row] for row in rows.tolist()]
        self._form.check(len(shown), WIDTH, HEIGHT)
        write_over(
            self._path, self._form.encode(_drawn(job.bench, shown, ended, told), _HELD), self._form.kind
        )


def _drawn(
    bench: Bench,
    moments: Sequence[_Moment],
    ended: float | None,
    told: Callable[[int, int], None],
) -> Iterator[Photograph]:
    photographer = Photographer(bench.model, width=_FINER * WIDTH, height=_FINER * HEIGHT, shadow=_SHADOW)
    for number, moment in enumerate(moments):
        told(number, len(moments))
        fine = photographer.take(*standing(bench.model, moment.qpos), _VIEW)
        small = np.asarray(cv2.resize(fine, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA), dtype=np.uint8)
        back = ended is not None and moment.time > ended
        caption = Caption(
            words=f"{'backwards' if back else 'forwards'}: {moment.words}",
            clock=clock(moment.time - moments[0].time), stages=2, begun=1 + back, stopped=False,
        )  # fmt: skip
        yield captioned(small, caption, None)
