"""Records every event of a run when it happens, and the poses of all bodies sixty times per second."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from google.protobuf.message import DecodeError

from handeye.core.errors import CannotWrite
from handeye.core.files import read_whole
from handeye.execution.servo import ServoPeriod
from handeye.ports.camera import Picture
from handeye.program.events import (
    Event,
    PartInspected,
    PartMatched,
    PartSeen,
    PictureTaken,
    RunStarted,
    StepStarted,
    WentBack,
)
from handeye.trace.frames import Frames, Mask
from handeye.trace.mcap_writer import GrowingFile
from handeye.trace.messages import Poses
from handeye.trace.records import known, read_messages, until
from handeye.trace.writing import TraceWriter
from handeye.vision.marks import Mark


def part(path: Path) -> Path:
    """Return the path of a trace that is still being written. When complete, the trace is renamed to `path`."""
    return path.with_name(f"{path.name}.part")


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureSource:
    """Provides the pictures of the program, and the marks on them. The recorder asks for them when an event concerns a
    picture.
    """

    picture: Callable[[str], Picture]  # the latest picture with this name
    found: Callable[[], tuple[str, Sequence[Mark]]]  # picture and marks that the present step found


class Recorder:
    """Writes the trace of a run. When the run goes back, the messages about the undone steps are removed.

    A run that was interrupted and resumed leaves the same trace, byte for byte, as an uninterrupted run. The first
    write error raises CannotWrite, and nothing more is written.
    """

    def __init__(
        self,
        path: Path,
        frames: Frames,
        looks: PictureSource,
        plan: bytes,
        *,
        old: bytes = b"",
        prefix: Sequence[Event] = (),
    ) -> None:
        """Begin a trace. An unfinished trace of another run at this path is replaced.

        `plan` is the content of `plan.json`. To resume a trace, give its content as `old`, and its first events as
        `prefix`. The content may be incomplete.
        """
        self._path, self._frames, self._looks, self._plan = path, frames, looks, plan
        self._waiting: list[tuple[ServoPeriod, Poses, Mask]] = []
        head = next((event for event in prefix if isinstance(event, RunStarted)), None)
        kept = known(old, prefix)
        self.lost = len(prefix) - kept  # events that the old trace lacked; the messages between them are lost
        self._writing = self._copied(old, kept, head)
        for event in prefix[self._writing.events :]:
            self._writing.event(event)

    @classmethod
    def resumed(
        cls,
        path: Path,
        frames: Frames,
        looks: PictureSource,
        plan: bytes,
        events: int,
        prefix: Sequence[Event],
    ) -> "Recorder":
        """Resume the trace of an interrupted run after its event number `events`.

        `prefix` are the events so far. Events that the trace lacks are written again, without the messages
        between them. If there is no trace, or if it belongs to another run, all events are written again.
        """
        prefix = prefix[:events]
        left = [read_whole(file) for file in (part(path), path) if file.exists()]
        old = max(left, key=lambda data: known(data, prefix), default=b"")
        recorder = cls(path, frames, looks, plan, old=old, prefix=prefix)
        recorder.flush()
        return recorder

    @property
    def broken(self) -> bool:
        """True if a write failed. The trace ends there."""
        return self._writing.file.broken

    # -- what happens -------------------------------------------------------------------------------

    def event(self, event: Event) -> None:
        """Write an event. The first event must be RunStarted. A trace contains no `WentBack`; `cut` removes the
        undone events instead."""
        if isinstance(event, WentBack):
            return
        self._catch_up()
        if isinstance(event, StepStarted):
            self._writing.frames(event.time, self._frames.poses(), self._frames.there())
        if isinstance(event, PictureTaken):
            self._writing.picture(event, self._looks.picture(event.picture))
        if isinstance(event, PartSeen | PartInspected | PartMatched):
            self._writing.found(event.time, *self._looks.found())
        self._writing.event(event)

    def tick(self, period: ServoPeriod) -> None:
        """Record a servo period that has passed, with the poses of all bodies.

        All periods since the last event are written together, just before the next event. Writing each period
        separately takes twice as long, because the simulation displaces the recorder from the processor's
        cache.
        """
        if self._writing.head is None:  # periods before the run are not recorded
            return
        self._waiting.append((period, self._frames.poses(), self._frames.there()))

    def flush(self) -> None:
        """Flush everything recorded so far to the disk."""
        self._catch_up()
        self._writing.file.sync()

    def cut(self, events: int) -> None:
        """Remove everything after event number `events`."""
        old = self._writing
        if not old.file.broken:
            old.file.sync()
            self._writing = self._copied(read_whole(old.file.file), events, old.head)
            old.file.release()
        self._waiting.clear()

    def close(self) -> None:
        """Complete the trace and rename it to its final path. A trace that could not be completed keeps its
        temporary name.
        """
        if self._writing.file.released:
            return
        try:
            self._catch_up()
            if self._writing.head is not None and not self._writing.file.broken:
                self._writing.file.finish()
                self._writing.file.move(self._path)
        finally:
            self._writing.file.release()
        if self._writing.head is None:
            part(self._path).unlink(missing_ok=True)

    # -- how it is written --------------------------------------------------------------------------

    def _catch_up(self) -> None:
        waiting, self._waiting = self._waiting, []
        if waiting:
            self._writing.periods(waiting)

    def _copied(self, old: bytes, events: int, head: RunStarted | None) -> TraceWriter:
        """Begin a new file, and copy into it the beginning of an old file, up to event number `events`. The new file
        replaces the old file.
        """
        file = GrowingFile(self._path.with_name(f".{self._path.name}.new"))
        writing = TraceWriter(file, self._frames, self._plan)
        try:
            if head is not None and events != 0:
                writing.begin(head)
            for message in until(read_messages(old, lenient=True), events):
                writing.copy(message)
            file.move(part(self._path))
        except (DecodeError, KeyError, ValueError):  # frames or channels that this scene does not have
            self._abandon(file)
            raise CannotWrite(
                f"the trace at {self._path} belongs to another scene; move the file elsewhere"
            ) from None
        except BaseException:
            self._abandon(file)
            raise
        return writing

    @staticmethod
    def _abandon(file: GrowingFile) -> None:
        file.release()
        file.file.unlink(missing_ok=True)
