"""Reads and writes the folder of a batch. The folder contains the settings of the batch (the head), the plan, and one
line for each finished trial.
"""

from collections.abc import Mapping
from pathlib import Path
from typing import Any, Final, Generic, Literal, TypeVar

import msgspec

from handeye.core.diagnostics import quoted
from handeye.core.entries import entries, loaded
from handeye.core.errors import BadArgument, BadFile, CannotWrite, NoSuchName
from handeye.core.files import LineFile, read_whole
from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.core.variation import Seed, WorldSpec
from handeye.core.versions import code_digest, versions
from handeye.planfile.plan import Plan
from handeye.planfile.store import alike, plan_digest, read_plan, write_plan
from handeye.runs.folder import TRIALS, check_exists
from handeye.trials.sweep import R, Sweep

_OURS: Final = {
    "assembly": "handeye.trials.plans.trial:ASSEMBLY",
    "dismantling": "handeye.trials.plans.trial:DISMANTLING",
    "faults": "handeye.trials.faults:FAULTS",
    "disturbed": "handeye.trials.disturbing:DISTURBED",
    "chaos": "handeye.trials.chaos.trials:CHAOS",
    "insertion": "handeye.trials.insertion:INSERTION",
    "rare": "handeye.trials.rare.row:RARE",
    "eye": "handeye.trials.eye:EYE",
    "episodes": "handeye.env.evaluation:EPISODES",
}


def sweep_of(kind: str) -> Sweep[Any]:
    """Return the kind of sweep that the folder of a batch names. Raises InvalidInput if this installation does
    not know the kind."""
    name = kind.partition(" ")[0]
    places = {name: place for entry in entries().values() for name, place in entry.sweeps.items()} | _OURS
    if name not in places:
        raise NoSuchName(
            f"there are no trials of the kind {quoted(name)} here; the kinds are {', '.join(sorted(places))}"
        )
    found = loaded(places[name])
    if not isinstance(found, Sweep):
        raise BadArgument(f"{places[name]} is {found!r}, which is not a Sweep")
    return found


T = TypeVar("T", bound=Record)

PLAN: Final = "plan.json"
_NAMES: Final = {
    "kind": "work", "plan": "plan", "world": "worlds", "seeds": "seeds", "camera": "camera", "without": "senses",
    "on_stop": "answers of the operator",
    "simulated_limit_s": "limit of simulated time", "versions": "versions", "code": "program",
}  # fmt: skip
"""The words that messages use for the fields of a batch's head."""


class Head(Record, frozen=True, kw_only=True):
    """The first line of a batch's file, with everything that determines the outcomes of the trials."""

    format: Literal["handeye batch"] = "handeye batch"
    version: Literal[2] = 2
    kind: str
    world: WorldSpec
    """The world of trial 0. The seed of trial k is the seed of this world plus k, unless `seeds` gives the seeds or
    several trials share a world.
    """
    seeds: tuple[Seed, ...] = ()  # Seeds of the trials, if they are not consecutive
    plan: str = ""  # Digest of the plan; empty: there is none
    program: str = ""
    camera: str = ""
    without: tuple[str, ...] = ()
    on_stop: str = "abort"  # How calls to the operator are answered
    simulated_limit_s: float | None = None
    settings: dict[str, str] = msgspec.field(default_factory=dict)
    """Further settings that determine the trials, by their display names."""
    versions: dict[str, str]
    code: str  # Digest of handeye and its scenes

    def seed_of(self, trial: int) -> int | None:
        """Return the seed of a trial's world, or None if there is no such trial."""
        if not self.seeds:
            return self.world.seed + trial
        return self.seeds[trial] if trial < len(self.seeds) else None

    def differs(self, other: "Head") -> list[str]:
        """Return the names of the fields in which two heads differ."""
        names = [told for name, told in _NAMES.items() if getattr(self, name) != getattr(other, name)]
        both = dict.fromkeys([*self.settings, *other.settings])
        return names + [name for name in both if self.settings.get(name) != other.settings.get(name)]


def head_of(
    sweep: Sweep[Any],
    world: WorldSpec,
    plan: Plan | None = None,
    settings: Mapping[str, str] | None = None,
    **more: Any,
) -> Head:
    """Return the head of a batch. The first trial of the batch, with number 0, is made in `world`. Raises InvalidInput
    if the installation is incomplete.
    """
    if plan is not None:
        more |= {"plan": plan_digest(plan), "program": plan.program.name}
    more |= {"settings": dict(settings or {}), "versions": versions(), "code": code_digest()}
    return Head(kind=sweep.kind, world=world, **more)


class BatchFolder(Generic[R]):
    """A folder into which each trial of a batch is written when it ends."""

    def __init__(
        self, path: Path, sweep: Sweep[R], head: Head, plan: Plan | None = None, *, anew: bool = False
    ) -> None:
        """Begin or continue a batch. If `anew` is True, delete the old batch first. Raises InvalidInput if the folder
        cannot be used.
        """
        self.path, self._sweep = path, sweep
        _check(path, sweep, head, plan, anew=anew)
        try:
            path.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise CannotWrite(f"{path} cannot be written: {error.strerror}") from None
        self._file = LineFile(path / TRIALS, "another command", again=not anew)
        self.rows: dict[tuple[str, int], R] = {}
        """Finished trials, by condition and number, except those that must be repeated."""
        try:
            self._begin(head, plan)
        except BaseException:
            self._file.close()
            raise

    @property
    def unlocked(self) -> str:
        """The reason why the folder could not be locked against other commands; empty if the folder is locked."""
        return self._file.unlocked

    def append(self, row: R) -> None:
        """Write the row of a trial. Raises InvalidInput if the disk is full."""
        self._file.append(msgspec.json.encode(row) + b"\n")
        self.rows[row.key] = row

    def close(self) -> None:
        """Close the file."""
        self._file.close()

    def _begin(self, head: Head, plan: Plan | None) -> None:
        empty = (self.path / TRIALS).stat().st_size == 0
        if plan is not None and (empty or not (self.path / PLAN).exists()):
            write_plan(self.path / PLAN, plan)
        if empty:
            self._file.append(msgspec.json.encode(head) + b"\n")
            return
        known = _same_batch(self.path, self._sweep, head, plan)
        self.rows = {row.key: row for row in known if not row.to_be_tried_again}


def read_batch(path: Path) -> tuple[Head, tuple[Any, ...]]:
    """Return the head of the batch in a folder, and its rows in the order of condition and number. Raises
    InvalidInput if the folder holds no batch.
    """
    check_exists(path)
    file = path / TRIALS
    if not file.is_file():
        raise BadFile(f"{path} holds no batch of trials: it has no {quoted(TRIALS)}")
    first, *lines = read_whole(file).split(b"\n")[:-1] or [b""]  # a line that was cut short has no end
    head = _decoded(first, Head, file, 1)
    return head, _rows(file, head, sweep_of(head.kind), lines)


def kept_trials(path: Path) -> set[tuple[str, int]]:
    """Return the condition and the number of each finished trial of the batch in a folder. The result is empty if the
    folder holds no batch.
    """
    if not (path / TRIALS).is_file() or not (path / TRIALS).stat().st_size:
        return set()
    return {row.key for row in read_batch(path)[1] if not row.to_be_tried_again}


def _rows(file: Path, head: Head, sweep: Sweep[R], lines: list[bytes]) -> tuple[R, ...]:
    rows = [_decoded(line, sweep.row, file, number) for number, line in enumerate(lines, 2)]
    for number, row in enumerate(rows, 2):
        if not sweep.shared_worlds and row.seed != head.seed_of(row.trial):
            raise BadFile(
                f"{file}, line {number}, has the seed {row.seed}, which is not that of trial {row.trial}"
            )
    return tuple(sorted({row.key: row for row in rows}.values(), key=lambda row: row.key))


def _decoded(line: bytes, kind: type[T], file: Path, number: int) -> T:
    try:
        return msgspec.json.decode(line, type=kind)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{file}, line {number}, cannot be read by this version of handeye: {error}") from None


def _same_batch(path: Path, sweep: Sweep[R], head: Head, plan: Plan | None) -> tuple[R, ...]:
    """Return the rows of the batch in a folder. Raises InvalidInput if the folder holds another batch."""
    file = path / TRIALS
    first, *lines = read_whole(file).split(b"\n")[:-1] or [b""]
    begun = _decoded(first, Head, file, 1)
    differs = head.differs(begun)
    if differs:
        raise CannotWrite(
            f"{path} holds {counted(len(lines), 'trial')} of another batch, which differs in "
            f"{', '.join(differs)}; choose another folder"
        )
    kept = read_plan(path / PLAN) if (path / PLAN).exists() else None
    if kept is not None and (plan_digest(kept) != head.plan or (plan is not None and not alike(kept, plan))):
        raise BadFile(f"{path / PLAN} is not the plan of the batch in {path}")
    return _rows(file, head, sweep, lines)


def _check(path: Path, sweep: Sweep[Any], head: Head, plan: Plan | None, *, anew: bool) -> None:
    """Raise InvalidInput if the contents of a folder forbid writing to it. The folder is not changed."""
    if not path.exists():
        return
    if (path / TRIALS).is_file() and (path / TRIALS).stat().st_size:
        if anew:
            read_batch(path)
        else:
            _same_batch(path, sweep, head, plan)
    if (path / TRIALS).exists():
        return
    if not path.is_dir():
        raise CannotWrite(f"{path} is not a folder")
    others = sorted(place.name for place in path.iterdir())
    if others:
        raise CannotWrite(
            f"{path} holds other files ({quoted(others[0])}); choose a new folder, or an empty one"
        )
