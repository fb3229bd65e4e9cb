"""Commands that measure how long things take."""

from __future__ import annotations

import tempfile
import time
from collections.abc import Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

from cyclopts import App, Parameter

from handeye.cli import insertion, speed
from handeye.cli.common import Camera, Json, WholeNumber, compiled, notes, positive, put_json, say, screen
from handeye.cli.world_options import ANY_WORLD, WorldOptions
from handeye.runs.scripts import default_script

if TYPE_CHECKING:
    from handeye.trials.peers import Comparison


def register(app: App) -> None:
    """Add the commands to the command line."""
    bench = App(name="bench", help="Measure how long things take.")
    for command in (timing, overhead, language, vision, ik):
        bench.command(command)
    speed.register(bench)
    insertion.register(bench)
    app.command(bench)


def timing(*, world: WorldOptions = ANY_WORLD, camera: Camera = "auto") -> int:
    """Assemble once and print the timing table beside that of 1973.

    Exit code 0: the program came to its end; 1: it stopped and called the operator.
    """
    from handeye.core.host_time import HostTimer
    from handeye.results.page import timing as table
    from handeye.results.progress import Progress
    from handeye.runs.host_seconds import Meter
    from handeye.trials.assembly import run_plan

    spec = world.spec
    started = time.process_time()
    plan = compiled(default_script())
    planning = time.process_time() - started
    with Progress(plan.program.stages, notes) as progress:
        finished = run_plan(
            plan,
            world=spec,
            camera=camera,
            meter=Meter(timer=HostTimer.of_process(), planning_cpu_s=planning),
            referee=False,
            observers=lambda _: [progress],
            viewed=progress.viewed,
            calibrate=True,
        )
    screen.print(table(finished.result))
    return 0 if finished.result.completed else 1


def overhead(*, world: WorldOptions = ANY_WORLD, camera: Camera = "auto") -> int:
    """Assemble once and measure the cost of checkpoints and trace, as shares of that run.

    Exit code 0: checkpoints under 2 % and trace under 10 % of the working phase; 1: more.
    """
    from handeye.results.progress import Progress
    from handeye.runs.setup import Setup
    from handeye.trials.overhead import measure

    spec = world.spec
    plan = compiled(default_script())
    setup = Setup(plan=plan, world=spec, camera=camera)
    with tempfile.TemporaryDirectory(prefix="handeye-") as folder, Progress(plan.program.stages, notes):
        cost = measure(setup, Path(folder) / "run")
    say(f"working phase without them   {cost.run:6.2f} s of this computer's clock")
    rows = (
        ("checkpoints", cost.checkpoints, f"{cost.kept} of them", 0.02),
        ("trace", cost.tracing, f"{cost.ticks} servo periods, {cost.trace_bytes / 1e6:.1f} MB", 0.10),
    )
    for name, seconds, what, limit in rows:
        share = seconds / cost.run
        say(f"{name:28} {seconds:6.2f} s  {share:6.2%} (at most {limit:.0%})  {what}")
    return 0 if all(seconds / cost.run < limit for _, seconds, _, limit in rows) else 1


def language(
    *,
    times: Annotated[WholeNumber, Parameter(help="How often each is measured.")] = 15,
    json: Json = False,
) -> int:
    """Measure the delay of a check, a keystroke and a plan, each time on a new text.

    Exit code 0: every median is under its target; 1: one is not.
    """
    from handeye.trials.language import measure

    positive(times, "time")
    measured = []
    for waiting in measure(times):
        measured.append(waiting)
        say(
            f"{waiting.what:26} {waiting.median * 1e3:7.1f} ms  (under {waiting.target * 1e3:.0f} ms)  "
            f"{times} times, {min(waiting.seconds) * 1e3:.1f} to {max(waiting.seconds) * 1e3:.1f} ms",
            notes if json else screen,
        )
    if json:
        put_json({"measured": [waiting.as_json() for waiting in measured]})
    return 0 if all(waiting.is_short for waiting in measured) else 1


def vision(
    *,
    poses: Annotated[WholeNumber, Parameter(help="How often the part is laid down somewhere.")] = 24,
    times: Annotated[WholeNumber, Parameter(help="How often each is measured.")] = 9,
    camera: Camera = "auto",
    json: Json = False,
) -> int:
    """Measure the eye beside OpenCV, on the same pictures of the cell.

    Exit code 0.
    """
    from handeye.tasks import task
    from handeye.trials.vision import measure

    positive(poses, "pose")
    positive(times, "time")
    _tell(list(measure(task().sights(poses, camera), times)), json)
    return 0


def ik(
    *,
    poses: Annotated[WholeNumber, Parameter(help="How many poses of the hand there are.")] = 200,
    times: Annotated[WholeNumber, Parameter(help="How often each is measured.")] = 9,
    json: Json = False,
) -> int:
    """Measure the arm's inverse kinematics beside those of the Robotics Toolbox, on the same poses of the hand.

    Exit code 0. The toolbox is large and no part of handeye: where it is not installed, it is not measured.
    """
    from handeye.tasks import task
    from handeye.trials.inverse_kinematics import measure

    positive(poses, "pose")
    positive(times, "time")
    _tell([measure(task().arm, poses, times)], json)
    return 0


def _tell(comparisons: Sequence[Comparison], json: bool) -> None:
    """Say what was measured."""
    for comparison in comparisons:
        for line in comparison.lines():
            say(line, notes if json else screen, whole=True)
    if json:
        put_json({"compared": [comparison.as_json() for comparison in comparisons]})
