"""Commands of the benches. One compares the times of the stages with those of 1973, the other inserts pins."""

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
PROGRAMS: Final = {"gentle": "the bench's own program", "1973": "the search from the listing of 1973"}
MOST_SD: Final = 5.0  # mm; with a larger error, most holes would be outside the search


def timing(*, world: WorldOptions = ANY_WORLD, camera: Camera = "auto") -> int:
    """Assemble once and print the times of the stages next to those of 1973.

    Exit code 0: the program finished; 1: the program stopped and called the operator.
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
    n: Annotated[WholeNumber, Parameter(name="--n", help="Number of trials for each condition.")] = GRID_N,
    seed: Annotated[WholeNumber, Parameter(help="Seed of the first world; each world has ten trials.")] = 0,
    clearance: Annotated[
        float | None,
        Parameter(
            help="Diametral clearance between hole and pin, mm: .05 to 1. Default: .114 if --chamfer or --sd is "
            "given; if neither is given, the command tries several clearances."
        ),
    ] = None,
    chamfer: Annotated[
        float | None,
        Parameter(
            help="Chamfer of the hole, mm: 0 (a sharp edge) to 2. Default: 1 if --clearance or --sd is given; if "
            "neither is given, the command tries several chamfers."
        ),
    ] = None,
    sd: Annotated[
        float | None,
        Parameter(
            help="Standard deviation of the hole's position error along each axis, mm: 0 to 5. Default: 1 if "
            "--clearance or --chamfer is given; if neither is given, the command tries several deviations."
        ),
    ] = None,
    search: Annotated[
        Literal["gentle", "1973"],
        Parameter(
            help="Search pattern: `gentle` is the pattern of the bench's own program, `1973` is the pattern of "
            "the program listing of 1973."
        ),
    ] = "gentle",
    options: SweepOptions = ANY,
) -> int:
    """Insert one pin into one hole, many times, and measure success rate, peak force, and time from first contact
    until the pin is seated.

    The arm, hand and servo are the same as in the pump's cell. The plate has one hole, which is displaced along each
    axis by a normally distributed error. As with the pump, worlds differ in the errors of arm and hand. A trial begins
    with the pin held over the hole. Without --clearance, --chamfer and --sd, the command tries the condition of a
    published benchmark, and several conditions that differ from this condition in one value. This takes some minutes.

    Peak force is the greatest force between pin and plate in any physics step, from the simulator's ground truth; the
    program never sees this force. Ctrl-C stops the command and prints the trials that have finished.

    Exit code 0: no silent failure; 1: no trial finished; 3: a silent failure: in some trial, the program reported
        success but the pin was not in its hole.
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
        title=f"insertion bench with {PROGRAMS[search]}, in worlds with seeds from {seed} upwards",
    )


def _conditions(
    clearance: float | None, chamfer: float | None, sd: float | None, search: Literal["gentle", "1973"]
) -> "list[Condition]":
    """The condition given by the options, or the grid of conditions; raises InvalidInput if a value is out of
    range.
    """
    from handeye.trials.insertion import Condition, grid

    if clearance is None and chamfer is None and sd is None:
        return grid(search)
    asked = {"clearance": clearance, "chamfer": chamfer, "sd": sd}
    for (name, value), (least, most) in zip(
        asked.items(), ((0.05, 1.0), (0.0, 2.0), (0.0, MOST_SD)), strict=True
    ):
        if value is not None and not least <= value <= most:
            raise BadArgument(f"--{name} must be between {least:g} and {most:g} mm, not {value:g}")
    return [Condition(search=search, **{name: value for name, value in asked.items() if value is not None})]
