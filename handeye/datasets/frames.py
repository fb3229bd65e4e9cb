"""Reduces a recorded run to frames, ten frames a second.

Each frame belongs to one moment. The observation of a frame is what the sensors read in the tenth of a second before
this moment. The action of a frame is what the arm did in the tenth of a second after this moment. So the observation
of a frame contains nothing that happened after the frame's action began.
"""

from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from handeye.core.errors import Refused
from handeye.core.plain_text import one_line
from handeye.core.pose import Array
from handeye.program.events import (
    AnyEvent,
    StageFinished,
    StageStarted,
    StepFinished,
    StepStarted,
    UndoStarted,
)
from handeye.trace.stages import CLOCKS
from handeye.trace.trace import Trace

RATE: Final = 10  # frames a second
NO_PICTURE: Final = -1  # number of the picture, and its age (s), before the first picture


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Frames:
    """A run as K frames, of an arm with n joints. Joint positions are in rad, or m if prismatic.

    The positions of a frame are the positions of the joints, followed by the opening of the fingers (m). While the
    brakes hold the arm for several servo periods, the sensors are not read. A frame in this time has the last reading
    before the brakes were set.
    """

    times: Array  # moments of the frames, s since the program began, shape (K,)
    state: Array  # positions as last read, shape (K, n + 1)
    state_mean: Array  # mean of the readings, shape (K, n + 1)
    rate: Array  # joint rates as last read, shape (K, n), rad/s or m/s
    torque: Array  # mean commanded joint torques, 0 under the brakes; shape (K, n), N m or N
    force: Array
    """Last estimate of the force (N) and moment (N m) that the hand exerts on its surroundings, shape (K, 6); 0 if
    there was no estimate.
    """
    force_mean: Array  # mean of the estimates, as `force`
    force_share: Array  # fraction of the servo periods in which force was estimated, shape (K,)
    picture: NDArray[np.intp]  # number of the last television picture, counted from 0, shape (K,)
    picture_age: Array  # s since it was taken, shape (K,)
    action: Array  # positions at the end of the next tenth of a second, shape (K, n + 1)
    stage: tuple[str, ...]  # name of the stage to which the action belongs; empty between stages
    instruction: tuple[str, ...]  # text of the instruction that makes the action; empty between instructions

    def __len__(self) -> int:
        return len(self.times)


def frames_of(trace: Trace) -> Frames:
    """Reduce a run to frames. Raises Refused if the run's trace is thinned or holds no motion."""
    if trace.thinned:
        raise Refused(f"{trace.name} is thinned, so most sensor readings are missing; use the original trace")
    motion, forces = trace.motion, trace.forces()
    if not len(motion.times):
        raise Refused(f"{trace.name} holds no motion of the arm")
    count = max(1, int(np.ceil(round(motion.times[-1] * RATE, 3))))
    moments = np.arange(1, count + 1) / RATE
    last, first = _windows(motion.times, moments)
    positions = np.column_stack([motion.joints, motion.gaps])
    wrench = np.where(forces.estimated[:, None], np.column_stack([forces.force, forces.moment]), 0.0)
    share, felt = _means(forces.estimated[:, None].astype(float), first, last), _means(wrench, first, last)
    numbers = np.searchsorted([shot.time for shot in trace.pictures], moments + CLOCKS) - 1
    taken = np.array([*(shot.time for shot in trace.pictures), np.nan])  # the last one for NO_PICTURE
    state = positions[last]
    return Frames(
        times=moments,
        state=state,
        state_mean=_means(positions, first, last),
        rate=motion.rates[last],
        torque=_means(motion.efforts, first, last),
        force=wrench[_last_felt(forces.estimated, first, last)] * (share > 0),
        force_mean=np.divide(felt, share, out=np.zeros_like(felt), where=share > 0),
        force_share=share[:, 0],
        picture=numbers,
        picture_age=np.where(numbers < 0, NO_PICTURE, np.round(moments - taken[numbers], 6)),
        action=np.concatenate([state[1:], state[-1:]]),
        stage=_in_progress(_stage_changes(trace.events), moments),
        instruction=_in_progress(_step_changes(trace.events), moments),
    )


def _windows(times: Array, moments: Array) -> tuple[NDArray[np.intp], NDArray[np.intp]]:
    """Return two arrays: for each frame, the index of its last reading, and the index of its first reading. A frame
    without a reading keeps the last reading before the frame.
    """
    end = np.searchsorted(times, moments + CLOCKS)
    begin = np.concatenate([[0], end[:-1]])
    last = np.maximum(end - 1, 0)
    return last, np.minimum(begin, last)


def _means(values: Array, first: NDArray[np.intp], last: NDArray[np.intp]) -> Array:
    """Return the means of the readings from `first` to `last`, both included, shape (K, ...)."""
    return np.array([values[a : b + 1].mean(axis=0) for a, b in zip(first, last, strict=True)])


def _last_felt(
    estimated: NDArray[np.bool_], first: NDArray[np.intp], last: NDArray[np.intp]
) -> NDArray[np.intp]:
    """For each frame, return the last reading that has an estimate of force, or the first reading if no reading of the
    frame has an estimate.
    """
    newest = np.maximum.accumulate(np.where(estimated, np.arange(len(estimated)), 0))
    return np.maximum(newest[last], first)


def _stage_changes(events: Iterable[AnyEvent]) -> Iterator[tuple[float, str]]:
    for event in events:
        if isinstance(event, StageStarted | StageFinished):
            yield event.time, event.stage if isinstance(event, StageStarted) else ""


def _step_changes(events: Iterable[AnyEvent]) -> Iterator[tuple[float, str]]:
    for event in events:
        if isinstance(event, UndoStarted):
            yield event.time, f"undo: {one_line(event.text)}"
        elif isinstance(event, StepStarted | StepFinished):
            yield event.time, one_line(event.text) if isinstance(event, StepStarted) else ""


def _in_progress(changes: Iterable[tuple[float, str]], moments: Array) -> tuple[str, ...]:
    """Return, for each moment, the text of the last change up to that moment."""
    told = [(-np.inf, ""), *changes]
    numbers = np.searchsorted([time for time, _ in told], moments + CLOCKS, side="right") - 1
    return tuple(told[number][1] for number in numbers.tolist())
