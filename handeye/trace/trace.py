"""A trace read from a file: the events of a run, and the recordings between the events."""

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
    """The recording of a run, read from a file and checked. Values computed from the recording are computed once
    and kept.

    Times are in seconds since the program began. Reading raises `InvalidInput` if a message does not match its
    channel.
    """

    name: str  # name of the file
    version: int  # version of the trace format
    head: RunStarted  # the beginning of the run: program, world, versions
    plan: bytes  # `plan.json` of the run
    events: tuple[AnyEvent, ...]  # all events, except those that were undone
    counts: dict[str, int]  # number of messages on each channel that has messages
    messages: tuple[RawMessage, ...]  # all messages, in the order in which they were written
    thinned: bool = False  # True if `handeye trace thin` has removed servo periods

    # -- what happened ---------------------------------------------------------------------------------

    @cached_property
    def stages(self) -> tuple[Stage, ...]:
        """The stages, as executed, in order."""
        return Several(stages(self.events))

    @cached_property
    def stages_both_ways(self) -> tuple[Stage, ...]:
        """Like `stages`, but also with the stages through which the arm went back to undo its work."""
        return Several(stages_both_ways(self.events))

    @cached_property
    def pictures(self) -> tuple[TakenPicture, ...]:
        """The pictures that the program took, in order."""
        return self._read(lambda messages: Several(read_pictures(messages)))

    # -- in every servo period -------------------------------------------------------------------------

    @property
    def times(self) -> Array:
        """Ends of the servo periods, s, shape (n,)."""
        return self.motion.times

    @property
    def joints(self) -> Array:
        """Sensed joint positions, shape (n, m): rad, or m for prismatic joints."""
        return self.motion.joints

    @property
    def rates(self) -> Array:
        """Sensed joint rates, shape (n, m): rad/s, or m/s for prismatic joints."""
        return self.motion.rates

    @property
    def efforts(self) -> Array:
        """Commanded joint torques, shape (n, m): N m, or N for prismatic joints; zero under the brakes."""
        return self.motion.efforts

    @property
    def gaps(self) -> Array:
        """Sensed opening of the fingers, m, shape (n,)."""
        return self.motion.gaps

    @property
    def poses(self) -> dict[str, Poses]:
        """Poses of all bodies by name, shape (n, 7) each: position in W (m), then a unit quaternion w, x, y, z.

        NaN while a body does not exist, such as the carrier of a screw before the screw is driven.
        """
        return Named(zip(self._replay.names, self._replay.poses.swapaxes(0, 1), strict=True))

    @cached_property
    def motion(self) -> Motion:
        """Motion of the joints during the whole run."""
        return self._read(lambda messages: read_motion(m for m in messages if m.topic == JOINTS))

    def forces(self, line: int | str | None = None) -> Forces:
        """The force of the hand on its surroundings, in the whole run or during one line of the script.

        Args:
            line: number of the line in the script, or `"pins.al:12"` for a line of a required file; all executions
                of the line are included. A motion belongs to its own line, not to the line of its `STOP`.

        Raises:
            InvalidInput: no such line was executed.
        """
        if line is None:
            return self._forces
        spans = [step.span for step in done_steps(self.events) if step.started.place == str(line)]
        if not spans:
            said = f"line {line} of {self.head.program} did not run in {self.name}"
            raise BadArgument(f"{said}{self._line_below(str(line))}")
        return self._forces.within(spans)

    def _line_below(self, place: str) -> str:
        """A hint with the next executed line, which is that of the motion if `place` is the line of its `STOP`."""
        file, _, number = place.rpartition(":")
        started = [step.started for step in done_steps(self.events) if step.started.file == file]
        below = [step for step in started if number.isdecimal() and step.line > int(number)]
        if not below:
            return ""
        nearest = min(below, key=lambda step: step.line)
        return f"; the next line that did is {nearest.place}: {one_line(nearest.text)}"

    @cached_property
    def channels(self) -> tuple[ChannelCurve, ...]:
        """Readings of the machines' own channels, each component over time; empty for a planned program."""
        return self._read(lambda messages: read_channels(m for m in messages if m.topic == MACHINES))

    @cached_property
    def _forces(self) -> Forces:
        times = self.times
        return self._read(lambda messages: recorded_forces(times, (m for m in messages if m.topic == HAND)))

    # -- at a moment -------------------------------------------------------------------------------------

    def at(self, time: float) -> Moment:
        """The state of the run at a time (s).

        Raises:
            InvalidInput: the time is no number or lies outside the recording, or nothing was recorded between the
                events.
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
        """A photograph of the cell at a time (s), shape (height, width, 3), red, green, blue.

        It is drawn from the recording, without simulation, and needs OpenGL.

        Args:
            camera: one of the scene's cameras; by default the one that shows the whole cell.
            fine: average many exposures with special lighting: soft shadows, depth of field, smooth edges.
            film: film of a fine photograph: `"colour"`, or `"1973"` for black and white.
            exposures: number of exposures of a fine photograph, 24 by default. Giving `exposures` or `film` implies
                `fine`.

        Raises:
            InvalidInput: for the reasons given at `at`; or the size or number of exposures is out of range, there
                is no such camera or film, or OpenGL is missing.
        """
        from handeye.cell.exposures import exposing, photographed
        from handeye.cell.posed import posed

        how = exposing(fine=fine, film=film, exposures=exposures)
        scene, moment = self.scene, self.at(time)
        model, data = posed(scene, moment.poses, moment.time)
        return photographed(model, data, camera=camera or self.overview, width=width, height=height, how=how)

    @cached_property
    def scene(self) -> Any:
        """The MuJoCo model of the run's scene in its initial state.

        Raises:
            InvalidInput: the run's task is unknown here.
        """
        from handeye.tasks import any_task

        return any_task(self.head.task).shown(self.head.world, self.plan)

    @property
    def overview(self) -> str:
        """The camera of the run's scene that shows the whole cell."""
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
        """One of the tables of the run: `joints` and `forces` have one row per servo period; `events` has time,
        line and text of each event.

        A notebook shows the table; `["time"]` gives a column, `to_pandas()` a DataFrame.

        Raises:
            InvalidInput: there is no such table, or a message does not match its channel.
        """
        from handeye.trace.tables import table

        return table(self, name)

    # -- what it can be used for -------------------------------------------------------------------------

    @cached_property
    def unseen(self) -> int:
        """Number of events before recordings begin between the events.

        It is greater than that of the start of the run and of its first stage if the run was resumed from a
        checkpoint. 0 for a system that moves no arm.
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
        """Time at which the recording of motions begins, s: 0, except for a run resumed from a checkpoint."""
        return self.events[max(self.unseen - 1, 0)].time

    @property
    def covers(self) -> tuple[float, float]:
        """Begin and end of the recording of motions, s.

        Raises:
            InvalidInput: nothing was recorded between the events.
        """
        if not len(self.times):
            raise Refused(f"{self.name} contains no motion to show")
        return self.begins, max(float(self.times[-1]), self.events[-1].time)

    def _read(self, make: Callable[[Iterator[RawMessage]], Read]) -> Read:
        """Compute a value from the messages; raises BadFile if a message is invalid."""
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
