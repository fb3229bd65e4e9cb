"""The folder of a batch: what the batch is, its plan, and a line for each trial that has ended."""

from pathlib import Path
from typing import Final, Literal, TypeVar

import msgspec

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadFile, CannotWrite
from handeye.core.files import read_whole
from handeye.core.line_file import LineFile
from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.planfile.plan import Plan
from handeye.planfile.store import plan_digest, read_plan, write_plan
from handeye.program.senses import Sense
from handeye.trials.batch.row import Row

R = TypeVar("R", bound=Record)

TRIALS: Final = "trials.jsonl"
PLAN: Final = "plan.json"
_NAMES: Final = {
    "work": "work", "plan": "plan", "world": "worlds", "camera": "camera", "without": "senses",
    "on_stop": "answers of the operator",
    "simulated_limit_s": "limit of simulated time", "versions": "versions", "code": "program",
}  # fmt: skip
"""What parts of a head are called."""


class Head(Record, frozen=True, kw_only=True):
    """First line of a batch's file: all that decides what its trials come to."""

    format: Literal["handeye batch"] = "handeye batch"
    version: Literal[1] = 1
    work: str = ""
    """What is done in each trial, where that is not to assemble."""
    plan: str
    """Digest of the plan."""
    program: str
    world: WorldSpec
    """The world of trial 0; that of trial k has a seed greater by k."""
    camera: str
    without: tuple[Sense, ...] = ()
    """Senses that the program does without."""
    on_stop: str = "abort"
    """How calls of the operator are answered."""
    simulated_limit_s: float
    versions: dict[str, str]
    code: str
    """Digest of handeye and its scenes."""

    def differs(self, other: "Head") -> list[str]:
        """Names of what is not the same in another one."""
        return [told for name, told in _NAMES.items() if getattr(self, name) != getattr(other, name)]


class BatchFolder:
    """A folder that trials are written to as they end."""

    def __init__(self, path: Path, head: Head, plan: Plan) -> None:
        """Begin a batch in a folder, or go on with it.

        Raises:
            InvalidInput: another batch or something else is in it, it cannot be written, or another command writes to
                it now.
        """
        self.path = path
        _check(path, head)
        try:
            path.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise CannotWrite(f"{path} cannot be written: {error.strerror}") from None
        self._file = LineFile(path / TRIALS, "another command")
        self.rows: dict[int, Row] = {}
        """Trials that have ended, by their numbers."""
        try:
            self._begin(head, plan)
        except BaseException:
            self._file.close()
            raise

    def append(self, row: Row) -> None:
        """Keep a trial.

        Raises:
            InvalidInput: there is no room.
        """
        self._file.append(msgspec.json.encode(row) + b"\n")
        self.rows[row.trial] = row

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _begin(self, head: Head, plan: Plan) -> None:
        if not (self.path / PLAN).exists() or (self.path / TRIALS).stat().st_size == 0:
            write_plan(self.path / PLAN, plan)
        if (self.path / TRIALS).stat().st_size == 0:
            self._file.append(msgspec.json.encode(head) + b"\n")
            return
        self.rows = {row.trial: row for row in _same_batch(self.path, head)}


def read_batch(path: Path) -> tuple[Head, tuple[Row, ...]]:
    """What a folder holds: the head, and the trials that have ended, by their numbers.

    Raises:
        InvalidInput: the folder holds no batch, or one that this handeye cannot read.
    """
    file = path / TRIALS
    if not file.is_file():
        raise BadFile(f"{path} holds no batch of trials: {quoted(TRIALS)} is not in it")
    first, *lines = read_whole(file).split(b"\n")[:-1] or [b""]  # a line that was cut short has no end
    head = _decoded(first, Head, file, 1)
    rows = [_decoded(line, Row, file, number) for number, line in enumerate(lines, 2)]
    for number, row in enumerate(rows, 2):
        if row.seed != head.world.seed + row.trial:
            raise BadFile(f"{file}, line {number}, has the seed {row.seed}, which trial {row.trial} has not")
    return head, tuple(sorted({row.trial: row for row in rows}.values(), key=lambda row: row.trial))


def _decoded(line: bytes, kind: type[R], file: Path, number: int) -> R:
    try:
        return msgspec.json.decode(line, type=kind)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{file}, line {number}, is of no batch that this handeye reads: {error}") from None


def read_plan_of(path: Path, head: Head) -> Plan:
    """The plan of a batch, from its folder.

    Raises:
        InvalidInput: it is not there, or another one is.
    """
    plan = read_plan(path / PLAN)
    if plan_digest(plan) != head.plan:
        raise BadFile(f"{path / PLAN} is not the plan of the batch in {path}")
    return plan


def _same_batch(path: Path, head: Head) -> tuple[Row, ...]:
    """The trials of a batch that a folder holds. Raises InvalidInput if it is another one."""
    begun, rows = read_batch(path)
    differs = head.differs(begun)
    if differs:
        raise CannotWrite(
            f"{path} holds {counted(len(rows), 'trial')} of another batch, which differs in "
            f"{', '.join(differs)}; choose another folder"
        )
    if (path / PLAN).exists():
        read_plan_of(path, head)
    return rows


def _check(path: Path, head: Head) -> None:
    """Raises InvalidInput if a folder may not be written, for what is in it; nothing there is touched."""
    if not path.exists():
        return
    if (path / TRIALS).is_file() and (path / TRIALS).stat().st_size:
        _same_batch(path, head)
    if (path / TRIALS).exists():
        return
    if not path.is_dir():
        raise CannotWrite(f"{path} is not a folder")
    others = sorted(place.name for place in path.iterdir())
    if others:
        raise CannotWrite(
            f"{path} holds other things ({quoted(others[0])}); choose a new folder, or an empty one"
        )
