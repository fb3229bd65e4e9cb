"""The states in which stages of a program begin. The program is executed up to a stage once per world, and the state
is then kept.

A start is a checkpoint. A start depends on the plan, the world, the renderer, the versions and the kind of processor.
The name of its file is a digest of all these conditions, so a file made under other conditions is never used.
"""

import hashlib
import platform
from functools import cache
from pathlib import Path
from typing import Final

import msgspec
from msgspec.structs import replace

from handeye import tasks
from handeye.core.entries import entries
from handeye.core.errors import BadFile, InvalidInput
from handeye.core.faults import Fault
from handeye.core.files import write_whole
from handeye.core.processor import processor
from handeye.core.record import Record
from handeye.core.resources import cache_folder
from handeye.core.variation import WorldSpec
from handeye.core.versions import code_digest, versions
from handeye.planfile.plan import Plan
from handeye.runs.checkpoint_file import ENDING, encode, read_checkpoint
from handeye.runs.runner import Runner
from handeye.runs.scripts import default_script, plan_script
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import digest_of, system_named

MOST: Final = 1 << 28  # bytes of all kept starts; beyond this the oldest are removed


class Conditions(Record, frozen=True, kw_only=True):
    """Everything on which a start depends."""

    plan: str
    world: WorldSpec
    camera: str
    stage: int
    versions: dict[str, str]
    code: str  # digest of handeye's code and scenes
    machine: tuple[str, ...]

    @property
    def name(self) -> str:
        """Name of the file of the start."""
        line = msgspec.json.encode(self, order="deterministic")
        return f"{hashlib.sha256(line).hexdigest()[:32]}{ENDING}"


def starts_folder() -> Path | None:
    """Return the folder of the user's starts; None if the user has no cache folder."""
    kept = cache_folder()
    return None if kept is None else kept / "starts"


def kept_starts(folder: Path | None) -> list[Path]:
    """Return the files of the starts in a folder, the newest first."""
    found = () if folder is None else folder.glob(f"[0-9a-f]*{ENDING}")
    return sorted(found, key=lambda path: path.stat().st_mtime, reverse=True)


class StartStates:
    """The start states of one task, kept in a folder. Without a folder, every start state is made again."""

    def __init__(self, task: str, camera: str, folder: Path | None = None) -> None:
        """Keep the starts of a task: the states in which its stages begin. `folder` is the folder in which they are
        stored, by default in the user's cache.
        """
        self._task, self._camera, self._folder = task, camera, folder or starts_folder()

    def before(self, stage: int, world: WorldSpec) -> Checkpoint | None:
        """Return the state in which the program begins a stage in a world; None if the program stops before that stage
        in this world. Stages are numbered from 0.
        """
        setup = own_setup(self._task, world, self._camera)
        kept = self._read(setup, stage)
        if kept is not None:
            return kept
        try:
            runner = Runner(Checkpoint(setup=setup))
        except BadFile:  # the program cannot be taught in this world
            return None
        while not runner.ended:
            at = runner.next
            if runner.between_stages and at is not None:
                self._keep(runner.checkpoint(), at.stage)
                if at.stage == stage:
                    return runner.checkpoint()
            runner.step()
        return None

    def _read(self, setup: Setup, stage: int) -> Checkpoint | None:
        path = self._path(setup, stage)
        if path is None:
            return None
        try:
            return read_checkpoint(path)
        except InvalidInput:
            return None

    def _keep(self, start: Checkpoint, stage: int) -> None:
        """Keep a start if there is room for it; a start that cannot be written is made again the next time."""
        path = self._path(start.setup, stage)
        if path is None or path.exists():
            return
        try:
            path.parent.mkdir(mode=0o700, parents=True, exist_ok=True)
            write_whole(path, encode(start))
            _trim(path.parent)
        except (OSError, InvalidInput):
            return

    def _path(self, setup: Setup, stage: int) -> Path | None:
        if self._folder is None:
            return None
        wanted = Conditions(
            plan=digest_of(setup), world=setup.world, camera=setup.camera, stage=stage, versions=versions(),
            code=code_digest(), machine=(platform.system(), processor()),
        )  # fmt: skip
        return self._folder / wanted.name


def planted(start: Checkpoint, fault: Fault) -> Checkpoint:
    """Return a start with one more fault in its world. The fault must not act before the start: up to then, the worlds
    with and without the fault are equal.
    """
    setup, snapshot = start.setup, start.snapshot
    assert snapshot is not None
    assert snapshot.cell is not None
    world = replace(setup.world, faults=(*setup.world.faults, fault))
    fresh, kept = tasks.task(setup.task).cell(world, setup.camera).capture(), snapshot.cell
    cell = replace(
        kept, figures={**fresh.figures, **kept.figures}, mechanisms={**fresh.mechanisms, **kept.mechanisms}
    )
    return replace(start, setup=replace(setup, world=world), snapshot=replace(snapshot, cell=cell))


def own_setup(task: str, world: WorldSpec, camera: str) -> Setup:
    """Return the setup of a run of a task's own program. The system to which the task belongs executes the program."""
    system = next((entry.name for entry in entries().values() if task in entry.tasks), None)
    if system is None:
        return Setup(plan=own_plan(task), world=world, camera=camera)
    return Setup(system=system, plan=_systems_plan(system, task), world=world, camera=camera)


@cache
def _systems_plan(system: str, task: str) -> Record:
    """Return the plan of a system's own program for a task. The plan is made only once, because handeye compares plans
    by identity.
    """
    plan: Record = system_named(system).own_plan(task)
    return plan


@cache
def own_plan(task: str) -> Plan:
    """Return the plan of a task's own program."""
    made = plan_script(default_script(tasks.task(task)))
    assert made.plan is not None, made.diagnostics
    return made.plan


def _trim(folder: Path) -> None:
    """Remove the oldest starts until a folder is within its limit."""
    together = 0
    for path in kept_starts(folder):
        together += path.stat().st_size
        if together > MOST:
            path.unlink(missing_ok=True)
