"""Manages the checkpoints of one run in a folder. This module writes and finds the checkpoints. If the run goes back
to an earlier point, the module removes the checkpoints made after that point.
"""

import re
from collections.abc import Iterator
from itertools import count
from pathlib import Path

from handeye.core.errors import BadFile, CannotWrite, InvalidInput
from handeye.core.files import write_whole
from handeye.runs.checkpoint_file import (
    ENDING,
    Head,
    encode,
    read_checkpoint,
    read_head,
    write_checkpoint,
)
from handeye.runs.parts import deciding, named
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import digest_of, listing_of, same_plan


class CheckpointStore:
    """The checkpoints in one folder."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder

    def save(self, checkpoint: Checkpoint) -> Path:
        """Write a checkpoint into a file whose name begins with the number of steps done. Returns the file's
        path."""
        path = self.folder / file_name(checkpoint)
        write_checkpoint(path, checkpoint)
        for other in self.folder.glob(f"{checkpoint.position:04}-*{ENDING}"):
            if (
                other != path
            ):  # an earlier state with the same number of steps, from before the operator's answer
                other.unlink(missing_ok=True)
        return path

    def heads(self) -> Iterator[tuple[Path, Head]]:
        """Yield the valid checkpoints' paths and summaries, the newest first."""
        for path in sorted(self.folder.glob(f"*{ENDING}"), key=_position, reverse=True):
            try:
                yield path, read_head(path)
            except InvalidInput:
                continue

    def moved(self) -> Iterator[Path]:
        """Yield the paths of the checkpoints made after the run began, including invalid checkpoints."""
        return (path for path in self.folder.glob(f"*{ENDING}") if _position(path) >= 0)

    def damaged(self) -> list[str]:
        """Return a sentence for each file that is not a valid checkpoint."""
        faults = []
        for path in sorted(self.folder.glob(f"*{ENDING}")):
            try:
                read_head(path)
            except InvalidInput as fault:
                faults.append(str(fault))
        return faults

    def check(self, setup: Setup) -> None:
        """Raise BadFile if the checkpoints in the folder belong to a run with another setup."""
        newest = next((path for path, _ in self.heads()), None)
        for path, head in self.heads():
            if (head.system, head.plan) != (setup.system, digest_of(setup)):
                raise BadFile(
                    f"{path} belongs to another plan ({head.program}, {head.plan}); choose another folder"
                )
            if path == newest and not same_plan(read_checkpoint(path).setup, setup):
                raise BadFile(
                    f"{path} belongs to another plan of this script, with different motions; choose another folder"
                )
            if (head.world, head.camera) != (setup.world, setup.camera):
                raise BadFile(
                    f"{path} belongs to another run ({head.world}, camera {head.camera}), not to this run "
                    f"({setup.world}, camera {setup.camera}); choose another folder"
                )
            if deciding(head.replaced or {}) != deciding(setup.replaced):
                raise BadFile(
                    f"{path} belongs to a run that uses {named(head.replaced or {})}, but this run uses "
                    f"{named(setup.replaced)}; choose another folder"
                )

    def claim(self, setup: Setup) -> None:
        """Raise InvalidInput if a run with the setup `setup` would overwrite checkpoints that could not be made
        again.
        """
        self.check(setup)
        for fault in self.damaged():
            raise CannotWrite(f"{self.folder} holds an unreadable file ({fault}); choose another folder")
        if any(head.touched for path, head in self.heads() if _position(path) >= 0):
            raise CannotWrite(
                f"{self.folder} belongs to a run with interventions by a person, which would be lost; choose "
                "another folder"
            )

    def newest(self) -> tuple[Checkpoint | None, list[str]]:
        """Return the valid checkpoint with the most steps done (None if no checkpoint is valid), and a sentence for
        each invalid file.
        """
        found, faults = None, []
        for path in sorted(self.folder.glob(f"*{ENDING}"), key=_position, reverse=True):
            try:
                if found is None:
                    found = read_checkpoint(path)
                else:  # older checkpoints are not resumed, so they need not be decoded
                    read_head(path)
            except InvalidInput as fault:
                faults.append(str(fault))
        return found, faults

    def at_or_before(self, position: int) -> Checkpoint | None:
        """Return the newest checkpoint that was made after at most `position` steps, or None if there is none. The
        checkpoint made before the run began does not count.
        """
        for path, head in self.heads():
            if head.position >= 0 and 0 <= _position(path) <= position:
                return read_checkpoint(path)
        return None

    def for_stage(self, setup: Setup, number: int) -> Checkpoint | None:
        """Return the checkpoint from which a run reaches stage `number` in the fewest steps, or None if no checkpoint
        is suitable.

        Checkpoints made after a person interfered do not count. Raises BadFile if the checkpoints belong to a run with
        another setup than `setup`.
        """
        self.check(setup)
        stages = listing_of(setup).stages
        for path, head in self.heads():
            if head.touched or head.stage is None or not head.between_stages:
                continue
            if head.stage in stages and stages.index(head.stage) <= number:
                return read_checkpoint(path)
        return None

    def drop_after(self, position: int) -> None:
        """Remove the checkpoints with more than `position` steps done."""
        for path in self.folder.glob(f"*{ENDING}"):
            if _position(path) > position:
                path.unlink(missing_ok=True)


def _position(path: Path) -> int:
    """Read the number of steps done from the name of a checkpoint's file. Returns -1 for the checkpoint made before
    the run began.
    """
    number = re.match(r"(\d+)-", path.name)
    return -1 if number is None else int(number[1])


def file_name(checkpoint: Checkpoint) -> str:
    """Return the name of a checkpoint's file. The name contains the number of steps done and the present or next
    stage, for example `0036-insert-the-aligning-pins.checkpoint`.
    """
    if checkpoint.snapshot is None:
        return f"start{ENDING}"
    words = re.sub(r"[^a-z0-9]+", "-", (checkpoint.stage or "end").lower()).strip("-")
    return f"{checkpoint.position:04}-{words}{ENDING}"


def leave(folder: Path, checkpoint: Checkpoint) -> Path:
    """Write a checkpoint under a new name, so that it replaces no other checkpoint. Returns the file's path."""
    state, setup, name = encode(checkpoint), checkpoint.setup, file_name(checkpoint)
    if _holds(folder / name, state):
        return folder / name
    program = re.sub(r"[^A-Za-z0-9_.-]+", "-", listing_of(setup).name).lstrip(".")
    stem = f"{program}-{setup.world.seed}-{name.removesuffix(ENDING)}"
    names = (stem if number == 1 else f"{stem}-{number}" for number in count(1))
    paths = (folder / f"{name}{ENDING}" for name in names)
    path = next(p for p in paths if not (p.exists() or p.is_symlink()) or _holds(p, state))
    write_whole(path, state)
    return path


def _holds(path: Path, state: bytes) -> bool:
    try:
        return path.read_bytes() == state
    except OSError:
        return False
