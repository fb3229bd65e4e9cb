"""A trace read from a file: the events of a run, and what was recorded between them."""

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

SHOWN: Final = 0.01  # s, to which times are shown; a typed time is no more exact than the one shown
Read = TypeVar("Read")


@dataclass(frozen=True, kw_only=True, eq=False, repr=False)
class Trace:
    """The recording of a run, read from a file and checked. Values derived from the recording are computed on
    first use and then cached.

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
        """The stages in the order in which they were executed."""
        return Several(stages(self.events))

    @cached_property
    def stages_both_ways(self) -> tuple[Stage, ...]:
        """Like `stages`, but includes the stages through which the arm went backwards to undo its work."""
        return Several(stages_both_ways(self.events))

    @cached_property
    def pictures(self) -> tuple[TakenPicture, ...]:
        """The pictures that the program took, the earliest first."""
        return self._read(lambda messages: Several(read_pictures(messages)))

    # -- in every servo period -------------------------------------------------------------------------

    @property
    def times(self) -> Array:
        """Time at the end of each servo period (s), shape (n,)."""
        return self.motion.times

    @property
    def joints(self) -> Array:
        """Sensed joint positions, in rad, or in m for prismatic joints; shape (n, m)."""
        return self.motion.joints

    @property
    def rates(self) -> Array:
        """Sensed joint velocities, in rad/s, or in m/s for prismatic joints; shape (n, m)."""
        return self.motion.rates

    @property
    def efforts(self) -> Array:
        """Commanded joint torques (N m), or forces (N) for prismatic joints; shape (n, m). The efforts are zero while
        the brakes are on.
        """
        return self.motion.efforts

    @property
    def gaps(self) -> Array:
        """Sensed opening of the fingers (m), shape (n,)."""
        return self.motion.gaps

    @property
    def poses(self) -> dict[str, Poses]:
        """Poses of all bodies by name, shape (n, 7) each: the position in W (m), then a unit quaternion w, x,
        y, z.

        A pose is NaN while its body does not exist. The carrier of a screw, for example, exists only when the
        screw is being driven.
        """
        return Named(zip(self._replay.names, self._replay.poses.swapaxes(0, 1), strict=True))

    @cached_property
    def motion(self) -> Motion:
        """Motion of the joints during the whole run."""
        return self._read(lambda messages: read_motion(m for m in messages if m.topic == JOINTS))

    def forces(self, line: int | str | None = None) -> Forces:
        """Return the force that the hand exerts on its surroundings, in the whole run or during one line of the
        script.

        Args:
            line: number of the line in the script. For a line of a required file, give a text such as
                `"pins.al:12"`. All executions of the line are included. A motion belongs to its own line, not
                to the line of its `STOP`.

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
        """Return a hint that names the next executed line. If `place` is the line of a `STOP`, the hint names the line
        of the motion to which the `STOP` belongs.
        """
        file, _, number = place.rpartition(":")
        started = [step.started for step in done_steps(self.events) if step.started.file == file]
        below = [step for step in started if number.isdecimal() and step.line > int(number)]
        if not below:
            return ""
        nearest = min(below, key=lambda step: step.line)
        return f"; the next line that ran is {nearest.place}: {one_line(nearest.text)}"

    @cached_property
    def channels(self) -> tuple[ChannelCurve, ...]:
        """Readings of the machines' own channels: each component over time. Empty for a planned program."""
        return self._read(lambda messages: read_channels(m for m in messages if m.topic == MACHINES))

    @cached_property
    def _forces(self) -> Forces:
        times = self.times
        return self._read(lambda messages: recorded_forces(times, (m for m in messages if m.topic == HAND)))

    # -- at a moment -------------------------------------------------------------------------------------

    def at(self, time: float) -> Moment:
        """Return the state of the run at a time (s).

        Raises:
            InvalidInput: the time is not a number, or lies outside the recording, or the trace contains no
                motion.
        """
        if not isinstance(time, (int, float, np.number)):
            raise BadArgument(f"a time must be a number of seconds, not {time!r}")
        begin, end = self.covers
        if not begin - SHOWN <= time <= end + SHOWN:
            raise BadArgument(f"{self.name} covers {begin:.2f} to {end:.2f} s; {time:g} s is outside")
        return self._replay.seek(time)

    def frame(
        self, time: float, camera: str | None = None, *, width: int = 1280, height: int = 960,
        fine: bool = False, film: str | None = None, exposures: int | None = None,
    ) -> NDArray[np.uint8]:  # fmt: skip
        """Return a photograph of the cell at a time (s), as red, green and blue values of shape (height, width,
        3).

        The photograph is rendered from the recorded poses, without simulation. This needs OpenGL.

        Args:
            camera: name of a camera in the scene; by default the camera that shows the whole cell.
            fine: average many exposures with special lighting, which gives soft shadows, depth of field and
                smooth edges.
            film: film of a fine photograph: `"colour"`, or `"1973"` for black and white.
            exposures: number of exposures of a fine photograph, 48 by default. Giving `exposures` or `film`
                implies
                `fine`.

        Raises:
            InvalidInput: the size or the number of exposures is out of range, there is no such camera or film, OpenGL
                is missing, or the time is one that `at` refuses.
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
            InvalidInput: this Python program does not know the run's task.
        """
        from handeye.tasks import any_task

        return any_task(self.head.task).shown(self.head.world, self.plan)

    @property
    def overview(self) -> str:
        """Name of the camera that shows the whole cell."""
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
        """Return one of the tables of the run. `joints` and `forces` have one row per servo period; `events`
        has the time, line and text of each event.

        A notebook displays the table. `["time"]` returns a column, and `to_pandas()` a DataFrame.

        Raises:
            InvalidInput: there is no such table, or a message does not match its channel.
        """
        from handeye.trace.tables import table

        return table(self, name)

    # -- what it can be used for -------------------------------------------------------------------------

    @cached_property
    def unseen(self) -> int:
        """Number of events that precede the first recorded servo period. Usually, these are the events that start the
        run and its first stage. In a run that was resumed from a checkpoint, the number is larger, because the earlier
        events are copied without the messages between them. For a system that moves no arm, the number is 0.
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
        """Time at which the recording of motions begins (s). The time is 0, unless the run was resumed from a
        checkpoint.
        """
        return self.events[max(self.unseen - 1, 0)].time

    @property
    def covers(self) -> tuple[float, float]:
        """The beginning and the end of the recording of motions (s).

        Raises:
            InvalidInput: the trace contains no motion.
        """
        if not len(self.times):
            raise Refused(f"{self.name} contains no motion to show")
        return self.begins, max(float(self.times[-1]), self.events[-1].time)

    def _read(self, make: Callable[[Iterator[RawMessage]], Read]) -> Read:
        """Compute a value from the messages. Raises BadFile if a message is invalid."""
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
