"""The folder that a run leaves: plan, events, trace, checkpoints, pictures, result.

It is an observer: it writes down what happens and changes nothing.
"""

import os
from pathlib import Path
from typing import Final

from handeye.cell.ports import Picture, Sensed
from handeye.errors import InvalidInput
from handeye.files import write_whole
from handeye.plan.plan import Plan
from handeye.plan.store import encode, plan_digest, read_plan
from handeye.pose import Array
from handeye.stepping.journal import Journal
from handeye.stepping.kept import Kept
from handeye.stepping.observer import Observer
from handeye.stepping.runner import Runner
from handeye.stepping.snapshot import Checkpoint
from handeye.trace.frames import Frames
from handeye.trace.recorder import Recorder
from handeye.work.events import AnyEvent

PLAN: Final = "plan.json"
EVENTS: Final = "events.jsonl"
TRACE: Final = "trace.mcap"
RESULT: Final = "result.json"
CHECKPOINTS: Final = "checkpoints"
PICTURES: Final = "pictures"


class RunFolder(Observer):
    """Keeps a run in a folder."""

    def __init__(self, path: Path, made: list[Path]) -> None:
        """Use `open_new` or `open_again`; `made` are the folders that are new, the innermost first."""
        self.path = path
        self.kept = Kept(path / CHECKPOINTS)
        self._made = made
        self._runner: Runner | None = None
        self._journal: Journal | None = None
        self._recorder: Recorder | None = None

    def watch(self, runner: Runner, start: Checkpoint, *, again: bool) -> "RunFolder":
        """Look at a run that begins, or with `again` goes on, from `start`.

        Raises:
            InvalidInput: the folder cannot be written to.
        """
        self._runner = runner
        plan = encode(runner.setup.plan).encode()
        frames, trace = Frames(runner.cell.truth), self.path / TRACE
        self._journal = Journal(self.path / EVENTS, anew=not again)
        if start.snapshot is None:
            self._recorder = Recorder(trace, frames, self._picture, plan)
        else:
            self._recorder = Recorder.resumed(
                trace, frames, self._picture, plan, len(start.events), start.events
            )
        if again:
            self._journal.undone(len(start.events), runner.run.time, "resumed")
        else:
            for event in start.events:
                self._journal.append(event)
        return self

    def _picture(self, name: str) -> Picture:
        assert self._runner is not None
        return self._runner.run.shots[name].picture

    # -- looking on -----------------------------------------------------------------------------------

    def event(self, event: AnyEvent) -> None:
        assert self._journal is not None
        assert self._recorder is not None
        self._journal.append(event)
        self._recorder.event(event)

    def tick(self, sensed: Sensed, effort: Array) -> None:
        assert self._recorder is not None
        self._recorder.tick(sensed, effort)

    def undone(self, events: int) -> None:
        assert self._journal is not None
        assert self._recorder is not None
        assert self._runner is not None
        self.kept.drop_after(self._runner.position)
        try:
            self._recorder.cut(events)
        finally:  # none of the three must go on as if nothing was undone
            self._journal.undone(events, self._runner.run.time, "back")

    def checkpoint(self, checkpoint: Checkpoint) -> None:
        assert self._recorder is not None
        self._recorder.flush()  # first: a checkpoint must not be ahead of the trace that leads to it
        self.kept.save(checkpoint)

    def keep_if_traced(self, checkpoint: Checkpoint) -> None:
        """Keep a state, unless the trace that leads to it was broken off in the middle of a write."""
        if self._recorder is None or not self._recorder.broken:
            self.checkpoint(checkpoint)

    def close(self) -> None:
        if self._journal is not None:
            self._journal.close()
        if self._recorder is not None:
            self._recorder.close()

    def discard(self) -> None:
        """Remove what `open_new` has made, if the run has not begun."""
        if self._runner is not None:
            return
        for path in (self.path / PLAN, self.path / CHECKPOINTS / "start.checkpoint"):
            path.unlink(missing_ok=True)
        for folder in self._made:
            if not any(folder.iterdir()):
                folder.rmdir()


def open_new(path: Path, start: Checkpoint) -> RunFolder:
    """A folder for a run that begins at `start`.

    The record of an earlier run with the same setup is replaced; it would come out the same.

    Raises:
        InvalidInput: the folder cannot be had, or holds something that would be lost.
    """
    Kept(path / CHECKPOINTS).check(start.setup)
    _check_plan(path, start.setup.plan)
    _refuse_touched(path)
    inner = [path / CHECKPOINTS, path / PICTURES]
    made = [place for place in (*inner, path, *path.parents) if not place.exists()]
    try:
        for place in inner:
            place.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InvalidInput(f"{path} cannot be made: {error.strerror}") from None
    if not all(os.access(place, os.W_OK) for place in (path, *inner)):
        raise InvalidInput(f"{path} cannot be written to")
    folder = RunFolder(path, made)
    folder.kept.drop_after(-1)
    for name in (EVENTS, TRACE, f"{TRACE}.part", RESULT):
        (path / name).unlink(missing_ok=True)
    write_whole(path / PLAN, encode(start.setup.plan).encode())
    folder.kept.save(start)
    return folder


def open_again(path: Path) -> tuple[RunFolder, Checkpoint]:
    """The folder of a run that was broken off, and its newest sound checkpoint.

    Raises:
        InvalidInput: there is none, or it is not of the plan in the folder.
    """
    folder = RunFolder(path, [])
    if not folder.kept.folder.is_dir():
        raise InvalidInput(f"{path} is not the folder of a run: it has no {CHECKPOINTS}")
    checkpoint = folder.kept.newest()
    if checkpoint is None:
        faults = folder.kept.damaged()
        raise InvalidInput(faults[-1] if faults else f"there is no checkpoint in {folder.kept.folder}")
    _check_plan(path, checkpoint.setup.plan)
    return folder, checkpoint


def _check_plan(path: Path, plan: Plan) -> None:
    beside = path / PLAN
    if beside.exists() and plan_digest(read_plan(beside)) != plan_digest(plan):
        raise InvalidInput(f"the runs in {path} are of another plan than this one, by {beside}")


def _refuse_touched(path: Path) -> None:
    """Raises InvalidInput if the record in the folder would not, or might not, come out again the same."""
    for fault in Kept(path / CHECKPOINTS).damaged():
        raise InvalidInput(f"{path} holds what cannot be read ({fault}); choose another folder")
    if any(head.touched for _, head in Kept(path / CHECKPOINTS).heads()):
        raise InvalidInput(
            f"{path} holds a run that somebody took a hand in, which would be lost; choose another folder"
        )
