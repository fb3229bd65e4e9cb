"""A trace that was read: what happened in a run, and what was recorded between the events."""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING, Any, Final, TypeVar

import msgspec
import numpy as np
from google.protobuf.message import DecodeError
from numpy.typing import NDArray

from handeye.core.brief import Named, Several
from handeye.core.errors import BadArgument, BadFile, Refused
from handeye.core.plain_text import counted, one_line
from handeye.core.pose import Array
from handeye.program.events import AnyEvent, RunStarted
from handeye.trace.channels import EVENTS, HAND, JOINTS, MACHINES, MOMENTS
from handeye.trace.forces import Forces, recorded_forces
from handeye.trace.messages import Poses
from handeye.trace.records import RawMessage
from handeye.trace.replay import (
    ChannelCurve,
    Moment,
    Motion,
    Replay,
    TakenPicture,
    read_channels,
    read_motion,
    read_pictures,
)
from handeye.trace.stages import Stage, done_steps, stages, stages_both_ways

if TYPE_CHECKING:
    from handeye.trace.table import Table

SHOWN: Final = 0.01  # s to which times are shown; what is typed is as exact as that
Read = TypeVar("Read")


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Trace:
    """A trace that was read, and found valid. What is computed from its messages is computed once.

    Times are s since the program began, everywhere. Reading raises `InvalidInput` if a message
    is not what its channel says.
    """

    name: str  # the file it was read from
    version: int  # version of the format
    head: RunStarted  # the beginning of the run: program, world, versions
    plan: bytes  # `plan.json` of the run
    events: tuple[AnyEvent, ...]  # everything that happened and was not undone
    counts: dict[str, int]  # messages on each channel that has any
    messages: tuple[RawMessage, ...]  # all of them, in the order they were written
    thinned: bool = False  # it holds some of the servo periods, not all: `handeye trace thin` wrote it

    # -- what happened ---------------------------------------------------------------------------------

    @cached_property
    def stages(self) -> tuple[Stage, ...]:
        """The stages as executed, in order."""
        return Several(stages(self.events))

    @cached_property
    def stages_both_ways(self) -> tuple[Stage, ...]:
        """The same, with those through which the arm went back to undo what it did."""
        return Several(stages_both_ways(self.events))

    @cached_property
    def pictures(self) -> tuple[TakenPicture, ...]:
        """The pictures that the program took, in order."""
        return self._read(lambda messages: Several(read_pictures(messages)))

    # -- in every servo period -------------------------------------------------------------------------

    @property
    def times(self) -> Array:
        """Ends of the servo periods, shape (n,), s."""
        return self.motion.times

    @property
    def joints(self) -> Array:
        """Positions of the joints by the sensors, shape (n, m), rad and (prismatic joints) m."""
        return self.motion.joints

    @property
    def rates(self) -> Array:
        """Rates of the joints by the sensors, shape (n, m), rad/s and m/s."""
        return self.motion.rates

    @property
    def efforts(self) -> Array:
        """Torques that the program put out, shape (n, m), N m and (prismatic joints) N; zero under the brakes."""
        return self.motion.efforts

    @property
    def gaps(self) -> Array:
        """Opening of the fingers by the sensor, shape (n,), m."""
        return self.motion.gaps

    @property
    def poses(self) -> dict[str, Poses]:
        """Poses of each body by name, shape (n, 7): place in W (m), then a unit quaternion w, x, y, z.

        NaN while a body did not exist, like the carrier of a screw before it is driven.
        """
        return Named(zip(self._replay.names, self._replay.poses.swapaxes(0, 1), strict=True))

    @cached_property
    def motion(self) -> Motion:
        """Motion of the joints in the whole run."""
        return self._read(lambda messages: read_motion(m for m in messages if m.topic == JOINTS))

    def forces(self, line: int | str | None = None) -> Forces:
        """Force of the hand on its surroundings, in the whole run or during a line of the script.

        Args:
            line: its number in the script, or `"pins.al:12"` in a file that the script requires; each time it was
                executed counts. A motion counts by its own line, not by that of its `STOP`.

        Raises:
            InvalidInput: no such line ran.
        """
        if line is None:
            return self._forces
        spans = [step.span for step in done_steps(self.events) if step.started.place == str(line)]
        if not spans:
            said = f"line {line} of {self.head.program} did not run in {self.name}"
            raise BadArgument(f"{said}{self._line_below(str(line))}")
        return self._forces.within(spans)

    def _line_below(self, place: str) -> str:
        """Report the next line that ran: that of the motion, where `place` is that of its `STOP`."""
        file, _, number = place.rpartition(":")
        started = [step.started for step in done_steps(self.events) if step.started.file == file]
        below = [step for step in started if number.isdecimal() and step.line > int(number)]
        if not below:
            return ""
        nearest = min(below, key=lambda step: step.line)
        return f"; the next line that did is {nearest.place}: {one_line(nearest.text)}"

    @cached_property
    def channels(self) -> tuple[ChannelCurve, ...]:
        """Readings of the machines' own channels, each component against time; empty for a planned program."""
        return self._read(lambda messages: read_channels(m for m in messages if m.topic == MACHINES))

    @cached_property
    def _forces(self) -> Forces:
        times = self.times
        return self._read(lambda messages: recorded_forces(times, (m for m in messages if m.topic == HAND)))

    # -- at a moment -------------------------------------------------------------------------------------

    def at(self, time: float) -> Moment:
        """The run as it was at a time (s).

        Raises:
            InvalidInput: it is no time, it is outside what was recorded, or nothing was recorded between the events.
        """
        if not isinstance(time, (int, float, np.number)):
            raise BadArgument(f"a time is a number of seconds, not {time!r}")
        begin, end = self.covers
        if not begin - SHOWN <= time <= end + SHOWN:
            raise BadArgument(f"{self.name} covers {begin:.2f} to {end:.2f} s; {time:g} s is outside")
        return self._replay.seek(time)

    def frame(
        self, time: float, camera: str | None = None, *, width: int = 1280, height: int = 960,
        fine: bool = False, film: str | None = None, exposures: int | None = None,
    ) -> NDArray[np.uint8]:  # fmt: skip
        """Photograph of the cell as it was at a time (s), shape (height, width, 3), red, green, blue.

        Nothing is simulated. It takes OpenGL.

        Args:
            camera: one of the scene's cameras; by default the one that shows all of it.
            fine: average many exposures in a light of their own: soft shadows, depth of field, smooth edges.
            film: of a fine photograph: `"colour"` or `"1973"`, black and white.
            exposures: of a fine photograph: how many, 24 by default. With this or `film` it is a fine one.

        Raises:
            InvalidInput: as `at`; the size or number of exposures is out of range; there is no such camera or film, or
                no OpenGL here.
        """
        from handeye.cell.exposures import exposing, photographed
        from handeye.cell.posed import posed

        how = exposing(fine=fine, film=film, exposures=exposures)
        scene, moment = self.scene, self.at(time)
        model, data = posed(scene, moment.poses, moment.time)
        return photographed(model, data, camera=camera or self.overview, width=width, height=height, how=how)

    @cached_property
    def scene(self) -> Any:
        """Model of the scene of its world at the start.

        Raises:
            InvalidInput: what it was drawn by is not known here.
        """
        from handeye.tasks import any_task

        return any_task(self.head.task).shown(self.head.world, self.plan)

    @property
    def overview(self) -> str:
        """The camera of its scene that shows all of it."""
        from handeye.tasks import any_task

        return any_task(self.head.task).camera

    @cached_property
    def _replay(self) -> Replay:
        motion, pictures = self.motion, self.pictures
        return self._read(lambda messages: Replay(motion, messages, self.events, pictures))

    # -- showing -----------------------------------------------------------------------------------------

    def __repr__(self) -> str:
        last = self.events[-1].time
        told = f"{counted(len(self.events), 'event')}, {counted(self.counts.get(JOINTS, 0), 'servo period')}"
        return f"<Trace of {self.head.program}, {self.head.world}: {told}, {self.begins:.2f} to {last:.2f} s>"

    def table(self, name: str = "events") -> "Table":
        """One of its tables: `joints` and `forces` by servo periods, or `events`: what happened, when, in which line.

        A notebook shows it; `["time"]` is a column, `to_pandas()` a DataFrame.

        Raises:
            InvalidInput: there is no such table, or a message is not what its channel says.
        """
        from handeye.trace.tables import table

        return table(self, name)

    # -- what it can be used for -------------------------------------------------------------------------

    @cached_property
    def unseen(self) -> int:
        """Events before the first of which more was recorded than that they happened.

        More than the start of the run and of its first stage, if it was resumed from a checkpoint. None of a system
        that moves no arm.
        """
        if not self.head.arm:
            return 0
        events = 0
        for message in self.messages:
            if message.topic in MOMENTS:
                break
            events += message.topic == EVENTS
        return events

    @property
    def begins(self) -> float:
        """When its motions begin to be recorded, s: 0, except for a run resumed from a checkpoint."""
        return self.events[max(self.unseen - 1, 0)].time

    @property
    def covers(self) -> tuple[float, float]:
        """From when to when its motions are recorded, s.

        Raises:
            InvalidInput: nothing was recorded between the events.
        """
        if not len(self.times):
            raise Refused(f"{self.name} holds no motion to show")
        return self.begins, max(float(self.times[-1]), self.events[-1].time)

    def _read(self, make: Callable[[Iterator[RawMessage]], Read]) -> Read:
        """Make something of the messages."""
        handed = self.messages[:1]

        def hand_out() -> Iterator[RawMessage]:
            nonlocal handed
            for message in self.messages:
                handed = (message,)
                yield message

        try:
            return make(hand_out())
        except (DecodeError, msgspec.DecodeError, KeyError, ValueError):
            what = " and ".join(f"{m.topic} at {m.time / 1e9:.3f} s" for m in handed)
            raise BadFile(f"{self.name}: the message on {what} cannot be read") from None
