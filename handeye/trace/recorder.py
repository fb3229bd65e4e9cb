"""Records a run as it happens: every event, and the position of everything sixty times a second."""

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
    """Path of a growing trace that will be at `path` when it is whole."""
    return path.with_name(f"{path.name}.part")


@dataclass(frozen=True, slots=True, kw_only=True)
class PictureSource:
    """Pictures of a program and marks on them, asked for when an event is about one."""

    picture: Callable[[str], Picture]  # the picture of a name, as it was taken last
    found: Callable[[], tuple[str, Sequence[Mark]]]  # picture and marks that the present step found


class Recorder:
    """Writes the trace of a run: what is undone is taken out again, so that the file holds what counted.

    A run that was interrupted and resumed any number of times leaves the same bytes as one that never was. A trace that
    cannot be written raises CannotWrite once, and nothing more is written.
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
        """Begin a trace; what another run left unfinished at its place is replaced.

        `plan` is the content of `plan.json`; `old` a trace to resume, whole or not, that begins with events `prefix`.
        """
        self._path, self._frames, self._looks, self._plan = path, frames, looks, plan
        self._waiting: list[tuple[ServoPeriod, Poses, Mask]] = []
        head = next((event for event in prefix if isinstance(event, RunStarted)), None)
        kept = known(old, prefix)
        self.lost = len(prefix) - kept  # events that the old trace did not hold, and what was sensed between
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
        """Resume the trace that a broken-off run left, after its event number `events`.

        Of `prefix`, the events so far, those that the trace has lost are written again, without what happened between
        them; if it is the trace of another run, or there is none, that is all of them.
        """
        prefix = prefix[:events]
        left = [read_whole(file) for file in (part(path), path) if file.exists()]
        old = max(left, key=lambda data: known(data, prefix), default=b"")
        recorder = cls(path, frames, looks, plan, old=old, prefix=prefix)
        recorder.flush()
        return recorder

    @property
    def broken(self) -> bool:
        """Something could not be written; the trace ends there."""
        return self._writing.file.broken

    # -- what happens -------------------------------------------------------------------------------

    def event(self, event: Event) -> None:
        """Write an event; the first is RunStarted. `WentBack` has no place in a trace: see `cut`."""
        if isinstance(event, WentBack):
            return
        self._catch_up()
        if isinstance(event, StepStarted):
            self._writing.frames(event.time, self._frames.poses(), self._frames.there(), anew=True)
        if isinstance(event, PictureTaken):
            self._writing.picture(event, self._looks.picture(event.picture))
        if isinstance(event, PartSeen | PartInspected | PartMatched):
            self._writing.found(event.time, *self._looks.found())
        self._writing.event(event)

    def tick(self, period: ServoPeriod) -> None:
        """Take down a servo period that has passed, and the frames.

        It is written before the next event, together with the periods around it: the simulation between two periods
        takes the processor's memory from the recorder, and writing each by itself takes twice as long.
        """
        if self._writing.head is None:  # what was before the run is no part of it
            return
        self._waiting.append((period, self._frames.poses(), self._frames.there()))

    def flush(self) -> None:
        """Put everything so far on the disk."""
        self._catch_up()
        self._writing.file.sync()

    def cut(self, events: int) -> None:
        """Take out everything after the first `events` events."""
        if not self._writing.file.broken:
            self._rewrite(events)
        self._waiting.clear()

    def close(self) -> None:
        """Put the trace in its place, whole. One that could not be written to its end stays where it grew."""
        if self._writing.file.released:
            return
        try:
            self._catch_up()
            if self._writing.file.uneven and not self._writing.file.broken:
                self._rewrite(None)
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
        for period, poses, there in waiting:
            self._writing.period(period)
            self._writing.frames(period.sensed.time, poses, there)

    def _rewrite(self, events: int | None) -> None:
        """Replace the file by a new one with its content up to event number `events`; None: with everything."""
        old = self._writing
        old.file.sync()
        self._writing = self._copied(read_whole(old.file.file), events, old.head)
        old.file.release()

    def _copied(self, old: bytes, events: int | None, head: RunStarted | None) -> TraceWriter:
        """Begin a new file with the content of an old one up to an event; it replaces the old one."""
        file = GrowingFile(self._path.with_name(f".{self._path.name}.new"))
        writing = TraceWriter(file, self._frames, self._plan)
        try:
            if head is not None and events != 0:
                writing.begin(head)
            for message in until(read_messages(old, lenient=True), events):
                writing.copy(message)
            file.move(part(self._path))
        except (DecodeError, KeyError, ValueError):  # frames or channels that there are not in this scene
            self._abandon(file)
            raise CannotWrite(f"the trace at {self._path} is of another scene; move it elsewhere") from None
        except BaseException:
            self._abandon(file)
            raise
        return writing

    @staticmethod
    def _abandon(file: GrowingFile) -> None:
        file.release()
        file.file.unlink(missing_ok=True)
