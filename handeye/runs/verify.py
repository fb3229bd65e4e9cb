"""Verifies a recorded run by repeating it and comparing both recordings."""

from collections.abc import Sequence
from pathlib import Path

from handeye.core.errors import Refused
from handeye.program.events import (
    AnyEvent,
    PanicStopped,
    StepFinished,
    StepStarted,
)
from handeye.runs.folder import TRACE, open_new
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.systems import system_named
from handeye.trace.compare import Repetition, compared
from handeye.trace.reading import Trace, read_trace


def setup_of(trace: Trace) -> Setup:
    """Return the setup with which a recorded run began, including the kind of renderer."""
    begun = trace.head
    plan = system_named(begun.system).decode(trace.plan, f"the plan in {trace.name}")
    camera = "gl" if begun.camera.method == "opengl" else "ray"
    return Setup(
        system=begun.system,
        plan=plan,
        world=begun.world,
        camera=camera,
        replaced=begun.own_parts,
        without=begun.lacking,
    )


def settled(events: Sequence[AnyEvent]) -> int:
    """Count the events of a run up to the step that the panic button interrupted. These events do not depend on the
    exact moment at which the button was pressed.
    """
    if not events or not isinstance(events[-1], PanicStopped):
        return len(events)
    steps = [n for n, event in enumerate(events) if isinstance(event, StepStarted)]
    ended = [n for n, event in enumerate(events) if isinstance(event, StepFinished)]
    broken = len(steps) > len(ended)
    return steps[-1] if broken else len(events) - 1


def difference(trace: Trace, folder: Path) -> str | None:
    """Repeat a run as `repetition` does, and return the first difference as a sentence. Two numbers count as different
    even if they differ only in their last digits. Returns None if there is no difference.
    """
    found = repetition(trace, folder)
    return found.rounded or found.parts


def repetition(trace: Trace, folder: Path) -> Repetition:
    """Repeat the run of a trace, and compare both recordings. The repeated run is written to the new folder `folder`.
    Raises Refused if the trace is thinned.
    """
    if trace.thinned:
        raise Refused(f"{trace.name} is thinned and cannot be verified; verify the original trace")
    wanted = trace.events[: settled(trace.events)]
    start = Checkpoint(setup=setup_of(trace))
    keeping = open_new(folder, start)
    try:
        runner = Runner(
            start, observers=lambda runner: [keeping.watch(runner, start, again=False)], calibrate=True
        )
        runner.repeat(wanted)
    finally:
        keeping.close()
    again = read_trace(folder / TRACE)
    return compared(trace, again, events=len(wanted), unseen=trace.unseen)
