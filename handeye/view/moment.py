"""Makes copies for viewers: of the present state of a run, and of the television picture. Because viewers receive only
copies, they cannot change the run.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Final

import msgspec
import numpy as np

from handeye.core.pose import Array
from handeye.execution.servo import ServoPeriod
from handeye.program import events as happened
from handeye.program.events import AnyEvent, PictureTaken
from handeye.report.facts.seen import Finding, SeenPicture
from handeye.report.page.seen import figure
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.system import Listing, RunningSystem
from handeye.trace.frames import Frames, NoFrames
from handeye.trace.messages import Poses
from handeye.trace.stages import done_steps

NEWS = PictureTaken | happened.PartSeen | happened.PartInspected | happened.PartMatched | happened.ErrorRaised
"""Events after which there is a new picture, or new findings in a picture."""


@dataclass(frozen=True, eq=False)
class Television:
    """A copy of the picture on the television, with what vision found in it. The run does not change the copy."""

    picture: SeenPicture | None = None
    """The last picture that the program took or examined, with its time; None if the program has taken no picture."""

    @property
    def shows(self) -> tuple[float, str, Sequence[Finding]] | None:
        """The time and the name of the picture on the television, and what vision found in this picture. Two pictures
        with the same values count as the same. The value is None if there is no picture.
        """
        return None if self.picture is None else (self.picture.time, self.picture.name, self.picture.findings)

    @cached_property
    def message(self) -> str:
        """The picture, encoded as a message for the viewers' pages. Without a picture, the markup in the message
        is empty.
        """
        shown = "" if self.picture is None else figure(self.picture, self.picture.name)
        return msgspec.json.encode({"television": str(shown)}).decode()


def television(runner: Runner) -> Television:
    """Return the picture that the television shows at present."""
    return shown(runner.events, runner.listing, runner.system)


def shown(events: Sequence[AnyEvent], listing: Listing, system: RunningSystem) -> Television:
    """Return the picture that the television shows after some events, copied from the memory of the program."""
    taken, findings = _last(events, listing) if system.shots else (None, ())
    if taken is None or taken.picture not in system.shots:
        return Television()
    return Television(
        SeenPicture(
            time=taken.time,
            name=taken.picture,
            lens=taken.lens,
            picture=system.shots[taken.picture].picture.copy(),
            marks=tuple(system.marks(taken.picture)),
            findings=tuple(findings),
        )
    )


def _last(events: Sequence[AnyEvent], listing: Listing) -> tuple[PictureTaken | None, Sequence[Finding]]:
    """Return the last picture that was taken or examined, and what vision found in it."""
    taken: dict[str, PictureTaken] = {}
    findings: dict[str, list[Finding]] = {}
    last = None
    for step in done_steps(events):
        for event in step.events:
            if isinstance(event, PictureTaken):
                taken[event.picture], findings[event.picture], last = event, [], event.picture
        examined = listing.steps[step.started.step].examines
        if examined in taken:
            findings[examined] += [event for event in step.events if isinstance(event, Finding)]
            last = examined
    return (None, ()) if last is None else (taken[last], findings[last])


FIGURES: Final = 5  # number of values before the joints: time, gap, and three components of the force


@dataclass(frozen=True, eq=False)
class Moment:
    """The state of the cell at the end of a servo period."""

    time: float  # s since the run began
    gap: float  # between the fingers, m
    force: Array | None  # force that the hand exerts on the world, shape (3,), N; None: it is not estimated
    joints: Array  # shape (n,), rad and m
    channels: Array  # components of the system's channels, shape (k,), SI; NaN: nothing was sensed yet
    poses: Poses  # poses of all bodies, shape (m, 7): place (m), quaternion w, x, y, z; NaN: absent

    @cached_property
    def packed(self) -> bytes:
        """The state as 32-bit little-endian numbers: `FIGURES`, joints, channels, poses. A force that is not
        estimated is NaN.
        """
        force = np.full(3, np.nan) if self.force is None else self.force
        numbers = (np.array([self.time, self.gap]), force, self.joints, self.channels, self.poses.ravel())
        return np.concatenate(numbers).astype("<f4").tobytes()


class Newest(Observer):
    """Keeps the newest state and the newest picture of a run for display. Other threads may read the state and the
    picture.
    """

    def __init__(self, runner: Runner) -> None:
        self.follow(runner)

    def follow(self, runner: Runner) -> None:
        """Follow a runner from now on. If the runner continues in the cell of another runner, the time also
        continues.
        """
        cell = runner.system.cell
        self.frames = NoFrames() if cell is None else Frames(cell.truth, runner.system.joints)
        self._runner = runner
        self._joints: Array = np.full(len(self.frames.joints), np.nan)
        self._gap = np.nan
        self.parts = tuple(
            (part, channel.unit) for channel in runner.system.channels for part in channel.parts
        )  # names and units of the components of its channels
        self._channels: Array = np.full(len(self.parts), np.nan)
        self.moment = self._now(None)
        self.television = television(runner)
        self.live = runner.system.live  # what the system shows in addition

    def event(self, event: AnyEvent) -> None:
        if isinstance(event, NEWS):
            self._look()

    def tick(self, period: ServoPeriod) -> None:
        sensed = period.sensed
        self._joints, self._gap = np.array(sensed.q), float(sensed.gap)
        if sensed.channels:
            self._channels = np.concatenate([np.array(values) for values in sensed.channels.values()])
        self.moment = self._now(None if period.wrench is None else np.array(period.wrench[:3]))

    def undone(self, events: int) -> None:
        self.moment = self._now(None)
        self._look()

    def _look(self) -> None:
        """Update the television picture. A picture that has not changed stays the same object, so that it is
        sent only once."""
        seen = television(self._runner)
        if seen.shows != self.television.shows:
            self.television = seen

    def _now(self, force: Array | None) -> Moment:
        poses = self.frames.poses()
        poses[~self.frames.there()] = np.nan
        time = (
            self._runner.time if self._runner.events else 0.0
        )  # before the program begins, the cell is prepared
        return Moment(
            time=time, gap=self._gap, force=force, joints=self._joints, channels=self._channels, poses=poses,
        )  # fmt: skip
