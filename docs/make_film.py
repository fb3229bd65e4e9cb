"""Makes the film that leads the README: three close-ups of a recorded run, with what the hand feels.

python docs/make_film.py [DIR]

Without DIR, the film shows the run of `handeye demo`. It needs OpenGL. `docs/make_readme_pictures.py film` does the
same.
"""

import sys
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

import handeye  # noqa: E402
from handeye.cell.photograph import Near, Photographer  # noqa: E402
from handeye.cell.posed import posed  # noqa: E402
from handeye.core.resources import demo  # noqa: E402
from handeye.program.events import StageStarted, StepFinished, StepStarted  # noqa: E402
from handeye.program.guards import GuardKind  # noqa: E402
from handeye.report.facts.felt import GuardedMotion, guarded_motions  # noqa: E402
from handeye.report.page.figures import clock  # noqa: E402
from handeye.report.recorded import RecordedRun  # noqa: E402
from handeye.video.captions import Caption, captioned, lettered  # noqa: E402
from handeye.video.formats import RATE, format_of  # noqa: E402

FILM = ROOT / "docs" / "pictures" / "assembly.webp"
WIDTH, HEIGHT, FINER, SHADOW = 520, 390, 2, 2048
HELD: Final = 10  # frame periods for which the last frame stays
GRASP, PINS = 1, 3  # numbers (from 0) of the stages in which the hand takes the base, and inserts the pins
CARD: Final = 0.30  # height of the graph, as a fraction of the frame's height
ASIDE: Final = np.array([-0.5, 0.86, 0.0])  # to the right, as seen by the camera
INK, CURVE, LIMIT = (60, 54, 48), (36, 96, 200), (190, 60, 40)

Picture = NDArray[np.uint8]


@dataclass(frozen=True, slots=True, kw_only=True)
class Close:
    """A close-up: a part of the run, what its caption says, and where the camera looks."""

    says: str
    begin: float  # s by the cell's clock
    end: float
    seconds: float  # duration in the film
    place: tuple[float, float, float]  # at which the camera looks (W, m)
    distance: float  # of the camera from this place, m
    turned: float  # angle of the camera about this place, degrees
    felt: GuardedMotion | None = None  # whose values the graph shows
    unit: str = ""


def close_ups(trace: "handeye.Trace") -> tuple[Close, ...]:
    """Return the three close-ups: the grasp of the base, the first pin in its hole, and the first screw."""
    stages = [event.time for event in trace.events if isinstance(event, StageStarted)]
    taken = [
        event.time
        for event in trace.events
        if isinstance(event, StepStarted) and event.text.startswith("CLOSE")
        and stages[GRASP] < event.time < stages[GRASP + 1]
    ][-1]  # fmt: skip
    met = [motion for motion in guarded_motions(RecordedRun(trace=trace)) if motion.trip is not None]
    pin = next(m for m in met if m.guard is GuardKind.FORCE and m.times[0] > stages[PINS])
    screw = next(m for m in met if m.guard is GuardKind.TORQUE)
    grip, hole, head = (_hand(trace, time) for time in (taken, pin.trip.time, screw.trip.time))  # type: ignore[union-attr]
    return (
        Close(
            says="grasp the base", begin=taken - 2.9, end=taken + 2.4, seconds=3.9, place=_beside(grip, 0.0, 0.08),
            distance=0.74, turned=4.0,
        ),
        Close(
            says="lower a pin into its hole", begin=pin.times[0] - 1.2, end=pin.times[-1] + 0.7, seconds=4.3,
            place=_beside(hole, 0.09, 0.09), distance=0.62, turned=-4.0, felt=pin, unit="N",
        ),
        Close(
            says="drive a screw", begin=screw.times[0] - 0.7, end=screw.times[-1] + 0.7, seconds=4.3,
            place=_beside(head, 0.09, 0.06), distance=0.66, turned=2.0, felt=screw, unit="N m",
        ),
    )  # fmt: skip


def _hand(trace: "handeye.Trace", time: float) -> tuple[float, float, float]:
    """Return the place of the hand after the last step that ended before a time (s)."""
    return [e.hand for e in trace.events if isinstance(e, StepFinished) and e.hand and e.time <= time + 0.1][
        -1
    ]


def _beside(place: Sequence[float], right: float, above: float) -> tuple[float, float, float]:
    """Return the place that is to the right of a place and above it (m)."""
    x, y, z = (np.array(place) + right * ASIDE).tolist()
    return x, y, z + above


def frames(trace: "handeye.Trace", every: int = 1) -> Iterator[Picture]:
    """Draw the film. With `every`, draw only some of its frames, to look at."""
    photographer = Photographer(trace.scene, width=FINER * WIDTH, height=FINER * HEIGHT, shadow=SHADOW)
    shown = close_ups(trace)
    for number, close in enumerate(shown, 1):
        count = round(close.seconds * RATE)
        for over in np.linspace(0, 1, count)[::every].tolist():
            time = close.begin + over * (close.end - close.begin)
            view = Near(camera="studio", place=close.place, distance=close.distance, turned=close.turned)
            drawn = photographer.take(*posed(trace.scene, trace.at(time).poses, time), view)
            small = np.asarray(
                cv2.resize(drawn, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA), dtype=np.uint8
            )
            caption = Caption(
                words=close.says, clock=clock(time), stages=len(shown), begun=number, stopped=False
            )
            said = captioned(small, caption, None)
            if close.felt is not None:
                _put(said, graph(close, close.felt, time))
            yield said


def _put(frame: Picture, card: Picture) -> None:
    """Put a graph into the upper right corner of a frame."""
    height, margin = round(CARD * HEIGHT), round(0.03 * HEIGHT)
    width = round(height * card.shape[1] / card.shape[0])
    frame[margin : margin + height, -margin - width : -margin] = cv2.resize(
        card, (width, height), interpolation=cv2.INTER_AREA
    )


def graph(close: Close, motion: GuardedMotion, time: float) -> Picture:
    """Draw what the hand feels in a guarded motion up to a time (s), and the value at which the motion stops."""
    width, height = 430, 285
    card = np.full((height, width, 3), (252, 250, 246), dtype=np.uint8)
    left, right, top, bottom = 24, width - 24, 84, height - 22
    most, begin, end = 1.3 * motion.limit, float(motion.times[0]) - 0.2, float(motion.times[-1])

    def at(when: float, value: float) -> tuple[int, int]:
        x = left + (when - begin) / (end - begin) * (right - left)
        return round(x), round(bottom - min(max(value / most, 0.0), 1.0) * (bottom - top))

    cv2.line(card, (left, bottom), (right, bottom), INK, 2, cv2.LINE_AA)
    limit = at(begin, motion.limit)[1]
    for x in range(left, right, 18):
        cv2.line(card, (x, limit), (min(x + 9, right), limit), LIMIT, 3, cv2.LINE_AA)
    digits, what = (1, "force") if motion.guard is GuardKind.FORCE else (2, "torque")
    _write(card, f"stops at {motion.limit:.{digits}f} {close.unit}", (limit + 4, limit + 60), LIMIT)
    past = motion.times <= time
    if past.any():
        now = min(time, end)
        value = float(np.interp(now, motion.times, motion.values))
        felt = [*zip(motion.times[past], motion.values[past], strict=True), (now, value)]
        points = np.array([at(float(when), float(each)) for when, each in felt], dtype=np.int32)
        cv2.polylines(card, [points], False, CURVE, 6, cv2.LINE_AA)
        cv2.circle(card, tuple(points[-1].tolist()), 11, CURVE, -1, cv2.LINE_AA)
        what = f"{what} {value:z.{digits}f} {close.unit}"
    _write(card, what, (6, 82), INK)
    return card


def _write(card: Picture, words: str, rows: tuple[int, int], colour: tuple[int, int, int]) -> None:
    band = card[rows[0] : rows[1]]
    ink = lettered(words, (len(band), card.shape[1]), card.shape[1] - 40, margin=24)[..., None]
    band[:] = (band * (1 - ink) + np.array(colour) * ink).astype(np.uint8)


def make(trace: "handeye.Trace") -> None:
    """Make the film."""
    FILM.write_bytes(format_of(FILM).encode(frames(trace), HELD))


if __name__ == "__main__":
    make(handeye.open(Path(sys.argv[1]) if sys.argv[1:] else demo() / "trace.mcap"))
