"""The folder of a run: plan, events, trace, checkpoints, pictures, result, report, video, and computing time.

The folder is an observer of the run: it records the run without changing it.
"""

import os
from collections.abc import Sequence
from contextlib import suppress
from pathlib import Path
from typing import TYPE_CHECKING, Final

import msgspec

from handeye.core.diagnostics import quoted
from handeye.core.entries import entries
from handeye.core.errors import BadFile, CannotWrite, InvalidInput
from handeye.core.files import read_whole, write_whole
from handeye.execution.servo import ServoPeriod
from handeye.ports.camera import Picture
from handeye.program.events import AnyEvent, RunFinished
from handeye.runs.checkpoint_store import CheckpointStore
from handeye.runs.host_seconds import HostSeconds, Meter, read_host_seconds, write_host_seconds
from handeye.runs.observer import Observer
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import same_plan, system_of, written
from handeye.trace.eventlist import Journal
from handeye.vision.marks import Mark

if TYPE_CHECKING:
    from handeye.trace.recorder import Recorder

PLAN: Final = "plan.json"
EVENTS: Final = "events.jsonl"
TRACE: Final = "trace.mcap"
RESULT: Final = "result.json"
CHECKPOINTS: Final = "checkpoints"
PICTURES: Final = "pictures"
HOST: Final = "host.json"
REPORT: Final = "report.html"
VIDEO: Final = "video.webp"
TRIALS: Final = "trials.jsonl"
"""A file that only the folder of a batch of trials contains."""
MARK: Final = "unnamed"
"""A file that marks a folder whose name was chosen by handeye, not by the user; see `runs/unnamed_runs.py`."""


def _outcomes() -> list[str]:
    """Return the names of the files that record the outcome of a run. The list includes the files of all systems."""
    return [RESULT, REPORT, VIDEO, *(name for entry in entries().values() for name in entry.files)]


class HoldsRun(CannotWrite):
    """Raised if a folder already holds a run, and a new run in the folder would replace it."""

    def __init__(self, path: Path) -> None:
        super().__init__(
            f"{path} holds a run: `handeye resume {path}` resumes it, --overwrite replaces it; to keep it, choose "
            "another folder"
        )
        self.path = path


class RunFolder(Observer):
    """Records a run in a folder."""

    def __init__(self, path: Path, made: list[Path]) -> None:
        """Do not create a `RunFolder` directly: use `open_new` or `open_again`. `made` are the newly created folders,
        the innermost first.
        """
        self.path = path
        self.kept = CheckpointStore(path / CHECKPOINTS)
        self._made = made
        self._closed = False
        self._continued = False  # the run has continued here: what shows its outcome is outdated
        self.lost = 0  # number of events that the trace of a resumed run has lost, with their motions
        self._first: Path | None = None  # the checkpoint that the run begins with, once it is written
        self._runner: Runner | None = None
        self._journal: Journal | None = None
        self._recorder: Recorder | None = None
        self.spent: HostSeconds | None = None  # host time of earlier sessions, if known
        self._meter = Meter()

    def watch(
        self, runner: Runner, start: Checkpoint, *, again: bool, meter: Meter | None = None
    ) -> "RunFolder":
        """Observe a run that begins at `start`, or that resumes there if `again` is True. `meter` measures the run's
        host time.
        """
        if (self.path / RESULT).is_dir():  # found now, not only when the run ends
            raise CannotWrite(f"{self.path / RESULT} cannot be written: it is a folder")
        self._runner, self._meter = runner, meter or Meter(before=self.spent)
        self._journal = Journal(self.path / EVENTS, start.events, again=again)
        if not again:
            self.begin(start)
        self._recorder = self._recording(start.events)
        if again:  # a new run has no earlier events in this folder
            self.lost = self._recorder.lost
            self._journal.undone(len(start.events), runner.time, "resumed")
        return self

    @property
    def journal_lost(self) -> bool:
        """True if the list of events was started from scratch when the run was resumed, because the old list
        was lost or belonged to another run.
        """
        return self._journal is not None and self._journal.lost

    @property
    def unlocked(self) -> str:
        """The reason why the folder could not be locked against other commands; empty if the folder is locked."""
        return "" if self._journal is None else self._journal.unlocked

    def begin(self, start: Checkpoint) -> None:
        """Replace the old run in the folder by the new run."""
        self.kept.drop_after(-1)
        left = [self.path / name for name in (TRACE, f"{TRACE}.part", HOST, *_outcomes())]
        for file in (*left, *(self.path / PICTURES).glob("*.png")):
            file.unlink(missing_ok=True)
        write_whole(self.path / PLAN, written(start.setup))
        self._first = self.kept.save(start)

    def _recording(self, events: Sequence[AnyEvent]) -> "Recorder":
        from handeye.trace.frames import Frames, NoFrames
        from handeye.trace.recorder import PictureSource, Recorder

        assert self._runner is not None
        setup, cell = self._runner.setup, self._runner.system.cell
        plan = written(setup)
        frames = NoFrames() if cell is None else Frames(cell.truth, self._runner.system.joints)
        looks = PictureSource(picture=self._picture, found=self._found)
        return Recorder.resumed(self.path / TRACE, frames, looks, plan, len(events), events)

    def _picture(self, name: str) -> Picture:
        assert self._runner is not None
        return self._runner.system.shots[name].picture

    def _found(self) -> tuple[str, Sequence[Mark]]:
        assert self._runner is not None
        return self._runner.system.just_found

    # -- reading --------------------------------------------------------------------------------------

    def event(self, event: AnyEvent) -> None:
        assert self._journal is not None
        assert self._recorder is not None
        self.check_traced()
        if not isinstance(event, RunFinished):  # `RunFinished` alone changes no outcome
            self._goes_on()
        self._journal.append(event)
        self._recorder.event(event)

    def tick(self, period: ServoPeriod) -> None:
        assert self._recorder is not None
        self._recorder.tick(period)

    def undone(self, events: int) -> None:
        assert self._journal is not None
        assert self._recorder is not None
        assert self._runner is not None
        self._goes_on()
        self.kept.drop_after(self._runner.position)
        try:
            self._recorder.cut(events)
        finally:  # events, trace and checkpoints must all drop what was undone
            self._journal.undone(events, self._runner.time, "back")

    def _goes_on(self) -> None:
        """Remove the files that hold the outcome of the run. The files are outdated when the run continues. While the
        run continues, other commands may write outdated files again. `close` removes these files.
        """
        if not self._continued:
            self._remove_outcome()
        self._continued = True

    def _remove_outcome(self) -> None:
        for name in _outcomes():
            with suppress(IsADirectoryError):  # a folder in its place is reported when the outcome is written
                (self.path / name).unlink(missing_ok=True)

    def checkpoint(self, checkpoint: Checkpoint) -> None:
        assert self._recorder is not None
        if self._recorder.broken:
            return
        self._recorder.flush()  # first: a checkpoint must not be ahead of the trace that leads to it
        self.kept.save(checkpoint)
        self._write_cost()

    def _write_cost(self) -> None:
        assert self._runner is not None
        write_host_seconds(self.path / HOST, self._meter.seconds(self._runner))

    def check_traced(self) -> None:
        """Raise CannotWrite if the trace could not be written. The run must not continue without its trace."""
        if self._recorder is not None and self._recorder.broken:
            raise CannotWrite(
                f"the trace in {self.path} was cut short; free some disk space, then `handeye resume {self.path}` "
                f"continues "
                "from the last checkpoint"
            )

    def close(self) -> None:
        if self._journal is not None:
            self._journal.close()
        if self._continued and not self._closed:
            self._remove_outcome()
        if self._recorder is not None:
            self._recorder.close()
            if not self._closed and not self._recorder.broken:
                self._write_cost()
        self._closed = True

    def discard(self) -> None:
        """Remove the folders that `open_new` created, if the run has not begun."""
        if self._recorder is not None:
            return
        if self._first is not None:
            self._first.unlink(missing_ok=True)
        if self._first is not None or self.path in self._made:
            (self.path / PLAN).unlink(missing_ok=True)
        if self._journal is not None and self.path in self._made:
            self._journal.close()
            (self.path / EVENTS).unlink()
        for folder in self._made:
            if not any(folder.iterdir()):
                folder.rmdir()


def open_new(path: Path, start: Checkpoint, *, overwrite: bool = False, unnamed: bool = False) -> RunFolder:
    """Create the folder of a new run. Raises CannotWrite if the folder already holds a run. With `overwrite`,
    the old run is replaced when the new one begins.
    """
    _refuse_others(path)
    if not overwrite:
        if _holds_run(path):
            raise HoldsRun(path)
        CheckpointStore(path / CHECKPOINTS).claim(start.setup)
        _check_plan(path, start.setup)
    inner = [path / CHECKPOINTS, path / PICTURES]
    made = [place for place in (*inner, path, *path.parents) if not place.exists()]
    try:
        for place in inner:
            place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise CannotWrite(f"the folder {path} cannot be created: {error.strerror}") from None
    if not all(os.access(place, os.W_OK) for place in (path, *inner)):
        raise CannotWrite(f"{path} cannot be written to")
    if not unnamed:
        (path / MARK).unlink(missing_ok=True)
    folder = RunFolder(path, made)
    try:
        if not _holds_run(path):
            folder.begin(start)
    except BaseException:
        folder.discard()
        raise
    return folder


def open_again(path: Path) -> tuple[RunFolder, Checkpoint, list[str]]:
    """Open the folder of an interrupted run. Returns the folder, its newest valid checkpoint, and a sentence
    for each file that cannot be used.

    Raises BadFile if there is no checkpoint, or if the checkpoint does not belong to the plan in the folder.
    """
    folder = RunFolder(path, [])
    if not folder.kept.folder.is_dir():
        if any(CheckpointStore(path).heads()):
            raise BadFile(f"{path} is a folder of checkpoints, not of a run; give the path of one checkpoint")
        check_holds_run(path)
        raise BadFile(f"the run in {path} cannot continue: the folder has no {CHECKPOINTS}")
    checkpoint, faults = folder.kept.newest()
    if checkpoint is None:
        raise BadFile(faults[0] if faults else f"there is no checkpoint in {folder.kept.folder}")
    _check_plan(path, checkpoint.setup)
    try:
        folder.spent = read_host_seconds(path / HOST)
    except InvalidInput as fault:
        faults.append(str(fault))
    return folder, checkpoint, faults


def check_exists(path: Path) -> None:
    """Raise BadFile if a path does not exist."""
    if not path.exists():
        raise BadFile(f"{path}: there is no such file")


def check_holds_run(path: Path) -> None:
    """Raise BadFile unless a path is a folder with files of a run. All commands use this check, so that they
    give the same message."""
    check_exists(path)
    if (path / TRIALS).is_file():
        raise BadFile(f"{path} is the folder of a batch of trials, not of a run")
    left = (PLAN, EVENTS, TRACE, f"{TRACE}.part", RESULT, CHECKPOINTS)
    if not any((path / name).exists() for name in left):
        raise BadFile(f"{path} holds no run")


def _check_plan(path: Path, setup: Setup) -> None:
    beside = path / PLAN
    if not beside.exists():
        return
    plan = system_of(setup).decode(read_whole(beside), str(beside))
    if not same_plan(msgspec.structs.replace(setup, plan=plan), setup):
        raise BadFile(f"{beside} shows that the runs in {path} belong to another plan")


def _holds_run(path: Path) -> bool:
    """Return True if the folder holds a run that has begun, not only the setup of a run."""
    records = any((path / name).exists() for name in (EVENTS, TRACE, f"{TRACE}.part", RESULT))
    return records or any(CheckpointStore(path / CHECKPOINTS).moved())


def _refuse_others(path: Path) -> None:
    """Raise InvalidInput if a folder contains files that do not belong to a run."""
    if others := _others(path):
        raise CannotWrite(
            f"{path} holds other files ({quoted(others[0])}); choose a new folder, or an empty one"
        )


def holds_only_a_run(path: Path) -> bool:
    """Return True if a folder contains only files of a run."""
    return not _others(path)


def _others(path: Path) -> list[str]:
    """Return the names of the files in a folder that do not belong to a run."""
    ours = {PLAN, EVENTS, TRACE, f"{TRACE}.part", CHECKPOINTS, PICTURES, HOST, MARK, *_outcomes()}
    if not (path / PLAN).is_file() and any((path / PICTURES).glob("*")):
        ours.remove(PICTURES)
    return (
        sorted(inside.name for inside in path.iterdir() if inside.name not in ours) if path.is_dir() else []
    )
