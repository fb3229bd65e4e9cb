"""Runs another plan in the world of a recorded run, to see what that plan would have done there."""

from pathlib import Path
from typing import Final

from handeye.cli.common import CameraKind
from handeye.cli.trace_files import trace_file
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, BadFile, Refused
from handeye.core.plain_text import counted
from handeye.core.variation import DRAWING
from handeye.planfile.plan import Plan
from handeye.program.events import AnyEvent, RunStarted
from handeye.runs.folder import EVENTS
from handeye.runs.setup import Setup
from handeye.trace.eventlist import read_events
from handeye.trace.reading import is_cut_short, read_trace

_CAMERAS: Final[dict[str, CameraKind]] = {"opengl": "gl", "rays": "ray"}


def in_world_of(path: Path, plan: Plan, *, judged: bool) -> Setup:
    """The setup of a plan that runs in the world of a recorded run. The faults and the camera are also those of the
    recorded run. Raises InvalidInput if the plan cannot run in that world.
    """
    events = _events(path)
    if not events or not isinstance(events[0], RunStarted):
        raise BadFile(f"{path} does not contain the start of the run, which records its world")
    begun = events[0]
    _check_drawing(path, begun)
    own = [part for part in begun.own_parts if part != "referee"]
    if own:
        raise Refused(
            f"the run in {path} used code of the calling program ({' and '.join(own)}); this command does not have "
            "that code"
        )
    _check_faults(path, begun, plan)
    if begun.task != plan.task:
        raise BadArgument(
            f"the run in {path} belongs to the task {quoted(begun.task)}, but the plan belongs to the task "
            f"{quoted(plan.task)}"
        )
    camera = _CAMERAS.get(begun.camera.method, "auto")
    return Setup(plan=plan, world=begun.world, camera=camera, judged=judged)


def _events(path: Path) -> tuple[AnyEvent, ...]:
    """Return the events of a run. Reads the run's event list if there is one: the list is shorter than the trace."""
    file = path / EVENTS if (path / EVENTS).is_file() else trace_file(path)
    if file.suffix == ".jsonl":
        return tuple(read_events(file, growing=True))
    return read_trace(file, lenient=is_cut_short(file)).events


def _check_drawing(path: Path, begun: RunStarted) -> None:
    """Raises InvalidInput if, in this version of handeye, the seed of the run does not give the recorded world."""
    world = begun.world
    if world.drawing != DRAWING:
        raise Refused(
            f"the world of {path} comes from another version of handeye: seed {world.seed} gives a different world "
            f"here (the rules that generate worlds have version {world.drawing} in that version of handeye, and "
            f"version {DRAWING} in this one)"
        )


def _check_faults(path: Path, begun: RunStarted, plan: Plan) -> None:
    """Raises InvalidInput if a fault begins with a stage that the plan does not have."""
    stages = len(plan.program.stages)
    for fault in begun.world.faults:
        if fault.stage is not None and fault.stage > stages:
            raise BadArgument(
                f"the fault {fault} of {path} begins at a stage that this plan does not have; the plan "
                f"has {counted(stages, 'stage')}"
            )
