"""Commands of the benches: the timing table beside that of 1973, and insertion."""

import time
from typing import TYPE_CHECKING, Annotated, Final, Literal

from cyclopts import Parameter

from handeye.cli.common import Camera, WholeNumber, notes, positive, screen
from handeye.cli.programs import plan_or_own
from handeye.cli.sweeps import ANY, SweepOptions, carry_out_sweep
from handeye.cli.world_options import ANY_WORLD, WorldOptions
from handeye.core.errors import BadArgument
from handeye.core.variation import WorldSpec, checked_seed

if TYPE_CHECKING:
    from handeye.trials.insertion import Condition

GRID_N: Final = 10
PROGRAMS: Final = {"gentle": "the bench's own program", "1973": "the search of the listing of 1973"}
MOST_SD: Final = 5.0  # mm: beyond it most holes would be beyond the search


def timing(*, world: WorldOptions = ANY_WORLD, camera: Camera = "auto") -> int:
    """Assemble once and print the timing table beside that of 1973.

    Exit code 0: the program finished; 1: it stopped and called the operator.
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
            meter=Meter(timer=HostTimer.of_command(), planning_cpu_s=planning),
            referee=False,
            observers=lambda _: [progress],
            viewed=progress.viewed,
            calibrate=True,
        )
    screen.print(table(finished.result))
    return 0 if finished.result.completed else 1


def insertion(
    *,
    n: Annotated[WholeNumber, Parameter(name="--n", help="Trials of each condition.")] = GRID_N,
    seed: Annotated[WholeNumber, Parameter(help="The first world; ten trials are made in each.")] = 0,
    clearance: Annotated[
        float | None, Parameter(help="Of the hole in diameter, mm: .05 to 1; .114 if others are given.")
    ] = None,
    chamfer: Annotated[
        float | None, Parameter(help="Of the hole, mm: 0 (a sharp edge) to 2; 1 if others are given.")
    ] = None,
    sd: Annotated[
        float | None,
        Parameter(
            help="Sigma of the error of the hole's place along each axis, mm: 0 to 5; 1 if others are given."
        ),
    ] = None,
    search: Annotated[
        Literal["gentle", "1973"],
        Parameter(help="The bench's own program, or the search of the listing of 1973."),
    ] = "gentle",
    options: SweepOptions = ANY,
) -> int:
    """Put one pin into one hole, many times: success, peak force, and time from the first contact to seated.

    The product's own arm, hand, servo and program, against a plate with one hole, which is off by a normal error along
    either axis. Worlds differ in the errors of the arm and the hand, as those of the pump do. A trial begins where the
    program has fetched the pin and holds it over the hole. Without --clearance, --chamfer and --sd, a grid around the
    setting of a published bench is tried, which takes some minutes.

    Peak force is the greatest between pin and plate in any physics step, by the simulator's truth; the program never
    knows it.

    Ctrl-C ends it and prints what has finished.

    Exit code 0: no silent failure; 1: every trial broke off; 3: in some trial the program said done, and the pin was
    not in its hole.
    """
    from handeye.trials.folder import head_of
    from handeye.trials.insertion import INSERTION, InsertionWork, insertion_cases

    positive(n, "trial")
    options.check()
    conditions = _conditions(clearance, chamfer, sd, search)
    cases, world = insertion_cases(conditions, n, checked_seed(seed)), WorldSpec(seed=seed)
    return carry_out_sweep(
        INSERTION,
        InsertionWork(conditions={each.name: each for each in conditions}),
        cases,
        head_of(INSERTION, world, camera="ray"),
        options,
        title=f"Insertion bench. Worlds from {seed} on; {PROGRAMS[search]}.",
    )


def _conditions(
    clearance: float | None, chamfer: float | None, sd: float | None, search: Literal["gentle", "1973"]
) -> "list[Condition]":
    """The condition that is asked for, or the grid; raises InvalidInput if it cannot be tried."""
    from handeye.trials.insertion import Condition, grid

    if clearance is None and chamfer is None and sd is None:
        return grid(search)
    asked = {"clearance": clearance, "chamfer": chamfer, "sd": sd}
    for (name, value), (least, most) in zip(
        asked.items(), ((0.05, 1.0), (0.0, 2.0), (0.0, MOST_SD)), strict=True
    ):
        if value is not None and not least <= value <= most:
            raise BadArgument(f"--{name} can be {least:g} to {most:g} mm; {value:g} is not")
    return [Condition(search=search, **{name: value for name, value in asked.items() if value is not None})]
