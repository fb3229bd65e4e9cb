"""The start of a run: either the beginning of a plan, or a saved state."""

import os
from dataclasses import dataclass
from pathlib import Path

import msgspec

from handeye import tasks
from handeye.api.plans import FileName, Planned, plan
from handeye.api.worlds import World
from handeye.core.arguments import given_file
from handeye.core.diagnostics import quoted
from handeye.core.entries import require
from handeye.core.errors import BadArgument, Refused
from handeye.core.host_time import HostTimer
from handeye.core.variation import WorldSpec, checked_seed
from handeye.debugger.breakpoints import stage_number
from handeye.ports.camera import Renderer
from handeye.program.events import RunStarted
from handeye.results.kept_run import has_ended
from handeye.runs.checkpoint_file import ENDING, read_checkpoint
from handeye.runs.checkpoint_store import CheckpointStore
from handeye.runs.folder import CHECKPOINTS, RunFolder, open_again
from handeye.runs.scripts import default_script
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import listing_of


@dataclass(frozen=True, slots=True, kw_only=True)
class RunRequest:
    """Options for a run, as the caller gave them. An option that was not given is None."""

    seed: object
    world: object
    camera: str | None
    task: str | None
    judged: bool
    limits: dict[str, float] | None
    replaced: dict[str, str]  # the parts that the caller replaced, each with the name of the caller's code

    @property
    def of_task(self) -> str | None:
        """Name of the requested task, or else the task of the requested world; None if neither a task nor a world was
        given.
        """
        return self.world.task if self.task is None and isinstance(self.world, World) else self.task

    @property
    def spec(self) -> WorldSpec | None:
        """The requested world; None if neither a seed nor a world was given. Raises InvalidInput if the world is
        invalid, or if both a seed and a world were given.
        """
        if self.world is None:
            return None if self.seed is None else WorldSpec(seed=checked_seed(self.seed))
        if self.seed is not None:
            raise BadArgument("give a seed or a world, not both: a world already has a seed")
        if isinstance(self.world, World):
            return self.world.spec
        if isinstance(self.world, WorldSpec):
            checked_seed(self.world.seed)
            return self.world
        raise BadArgument(f"a world must be a handeye.World, not {self.world!r}")


@dataclass(frozen=True, slots=True, kw_only=True)
class Start:
    """The state in which a run starts, the folder to resume in, and the CPU time spent on planning (s)."""

    state: Checkpoint
    folder: RunFolder | None = None
    planning_cpu_s: float = 0.0  # seconds of this computer's processor for the planning phase


def start_of(
    script: FileName | Planned | None,
    wanted: RunRequest,
    *,
    stage: str | None,
    taught: FileName | None,
    out: FileName | None,
) -> Start:
    """Find the state in which a run starts, from the arguments of `handeye.begin`. Raises InvalidInput for the reasons
    that `handeye.begin` lists.
    """
    if isinstance(script, (str, os.PathLike)) and _is_kept(script):
        if taught is not None:
            raise Refused("a resumed run already has its positions; omit `taught=...`")
        if out is not None and stage is None and os.path.realpath(out) == os.path.realpath(script):
            return _again(script, wanted)
        return Start(state=_kept(script, stage, wanted))
    timer = HostTimer()
    made = plan(
        default_script(tasks.task(wanted.of_task or tasks.DEFAULT)) if script is None else script,
        taught=taught,
        task=wanted.of_task,
    )
    setup = Setup(
        plan=made.record,
        world=wanted.spec or WorldSpec(seed=0),
        camera=wanted.camera or "auto",
        judged=wanted.judged,
        limits=wanted.limits or {},
        replaced=wanted.replaced,
    )
    return Start(state=Checkpoint(setup=setup), planning_cpu_s=timer.cpu_s)


def _is_kept(given: FileName) -> bool:
    """Return True if `given` is the path of a checkpoint or of a folder, not a script."""
    name = os.fspath(given)
    return bool(name) and "\n" not in name and (name.endswith(ENDING) or os.path.isdir(name))


def _kept(given: FileName, at: str | None, wanted: RunRequest) -> Checkpoint:
    """Read a saved state. If `given` is a checkpoint, that checkpoint is the state. If `given` is a folder, the state
    is the newest in this folder or, with `at`, the newest before the stage `at`. Raises InvalidInput if the folder
    contains no saved state, or if the plan has no stage `at`.
    """
    path = given_file(given, "resume a run from a file or a folder")
    start = open_again(path)[1] if path.is_dir() else read_checkpoint(path)
    if at is not None and path.is_dir():
        number = stage_number(at, listing_of(start.setup))
        found = CheckpointStore(path / CHECKPOINTS).for_stage(start.setup, number)
        start = found or Checkpoint(setup=start.setup)
    _check_same(path, start.setup, wanted)
    return _with_parts(start, wanted)


def _again(given: FileName, wanted: RunRequest) -> Start:
    """Open the folder of a run, so that the run continues in this folder from its newest state. Raises InvalidInput if
    the run cannot be resumed in this folder.
    """
    path = given_file(given, "resume a run from a folder")
    folder, start, _ = open_again(path)
    if has_ended(path, start, judged=start.setup.judged):
        raise Refused(f"the run in {path} has ended; omit `out=...` to open the run and go back in it")
    _check_same(path, start.setup, wanted)
    if wanted.replaced or wanted.limits not in (None, start.setup.limits):
        raise Refused(
            f"the run in {path} must keep its search pattern, its camera and its referee; to replace them, choose "
            "another folder as out=..."
        )
    return Start(state=start, folder=folder)


def _check_same(path: Path, begun: Setup, wanted: RunRequest) -> None:
    """Raise InvalidInput unless the saved run was begun with the requested plan, world and camera."""
    require(begun.system, "python", str(path))
    if wanted.of_task not in (None, begun.task):
        told = f"{quoted(begun.task)}, not to {quoted(str(wanted.of_task))}"
        raise Refused(f"the run in {path} belongs to the task {told}")
    if wanted.spec is not None and wanted.spec != begun.world:
        raise Refused(f"the run in {path} uses the world of {begun.world}, not the world of {wanted.spec}")
    if wanted.camera is not None and wanted.camera != begun.camera:
        raise Refused(f"the run in {path} uses the camera `{begun.camera}`, not `{wanted.camera}`")


def _with_parts(start: Checkpoint, wanted: RunRequest) -> Checkpoint:
    """Return the checkpoint with the caller's search pattern, camera and referee in place of those that were saved.
    The setup and the first event of the returned checkpoint name the caller's parts.
    """
    if not wanted.replaced and not wanted.judged and wanted.limits is None:
        return start
    setup = start.setup
    replaced = setup.replaced | wanted.replaced
    for part, name in setup.replaced.items():
        if part != "referee" and part in wanted.replaced and wanted.replaced[part] != name:
            raise Refused(
                f"the run began with `{name}` as its {part}, but `{wanted.replaced[part]}` was given"
            )
    events = start.events
    if wanted.replaced and events and isinstance(events[0], RunStarted):
        camera = wanted.replaced.get("camera")
        eye = events[0].camera if camera is None else Renderer(method="replaced", platform=camera)
        events = (msgspec.structs.replace(events[0], replaced=replaced, camera=eye), *events[1:])
    changed = msgspec.structs.replace(setup, replaced=replaced, judged=setup.judged or wanted.judged)
    return msgspec.structs.replace(start, setup=_with_referee(changed, wanted), events=events)


def _with_referee(setup: Setup, wanted: RunRequest) -> Setup:
    """Return the setup of a run, with the caller's referee or limits in place of the original ones."""
    if "referee" in wanted.replaced:
        return msgspec.structs.replace(setup, limits={})
    if wanted.limits is None:
        return setup
    others = {part: name for part, name in setup.replaced.items() if part != "referee"}
    return msgspec.structs.replace(setup, limits=wanted.limits, replaced=others)
