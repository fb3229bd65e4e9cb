"""Commands that measure how long things take."""

from __future__ import annotations

import time
from typing import TYPE_CHECKING

from handeye.cli.common import Camera, notes, screen
from handeye.cli.programs import plan_or_own
from handeye.cli.world_options import ANY_WORLD, WorldOptions

if TYPE_CHECKING:
    pass


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
    plan = plan_or_own(None, world.task)
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
