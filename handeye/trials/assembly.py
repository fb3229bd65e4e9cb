"""Executes one whole run: calibrates the camera in a world, executes a plan, and lets the referee judge the
result."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass

from handeye.cell.arm import ArmState
from handeye.cell.simulated import SimulatedCell
from handeye.core.variation import WorldSpec
from handeye.planfile.plan import Plan
from handeye.results.finishing import finished
from handeye.results.judging import Limits, Referee, check_limits
from handeye.results.result import Result
from handeye.runs.host_seconds import Meter
from handeye.runs.observer import Observer
from handeye.runs.operator import NOBODY, Operator, attend
from handeye.runs.parts import OWN, Parts
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint


@dataclass(frozen=True, slots=True, kw_only=True)
class FinishedRun:
    """A run that has ended: its result, and its runner in the final state."""

    result: Result
    runner: Runner


def run_plan(
    plan: Plan,
    *,
    world: WorldSpec,
    camera: str = "auto",
    meter: Meter | None = None,
    referee: bool = True,
    limits: Limits | None = None,
    parts: Parts = OWN,
    own_referee: Referee | None = None,
    observers: Callable[[Runner], Sequence[Observer]] = lambda _: (),
    viewed: Callable[[int, int], None] = lambda *_: None,
    calibrate: bool = False,
    halt: Callable[[], bool] = lambda: False,
    without: tuple[str, ...] = (),
    operator: Operator = NOBODY,
) -> FinishedRun:
    """Execute a plan in a world, and let the referee judge the result.

    Args:
        meter: measures the host time of the run; by default, the measurement begins with this call.
        viewed: called for each view of the camera calibration, with the number of the view and the total number
            of views.
        halt: the panic button, polled in every servo period.

    Raises InvalidInput if the plan was made for another arm, or if the limits or the camera cannot be used. Raises
    Halted if the panic button is pressed before the working phase.
    """
    setup = Setup(
        plan=plan,
        world=world,
        camera=camera,
        limits={**(limits or {})},
        replaced=parts.names,
        without=without,
    )
    return run_on(
        Checkpoint(setup=setup), meter=meter, referee=referee, parts=parts, own_referee=own_referee,
        observers=observers, viewed=viewed, calibrate=calibrate, halt=halt, operator=operator,
    )  # fmt: skip


def run_on(
    start: Checkpoint,
    *,
    meter: Meter | None = None,
    referee: bool = True,
    parts: Parts = OWN,
    own_referee: Referee | None = None,
    observers: Callable[[Runner], Sequence[Observer]] = lambda _: (),
    viewed: Callable[[int, int], None] = lambda *_: None,
    calibrate: bool = False,
    halt: Callable[[], bool] = lambda: False,
    operator: Operator = NOBODY,
) -> FinishedRun:
    """Continue a run from a checkpoint, and let the referee judge the result. The checkpoint may be at the beginning
    of the run. The arguments are those of `run_plan`.
    """
    metered = meter or Meter()
    runner = Runner(
        start,
        halt=halt,
        viewed=viewed,
        observers=observers,
        parts=parts,
        calibrate=calibrate,
    )
    check_limits(runner)
    result = finished(runner, attend(runner, operator), metered, judged=referee, referee=own_referee)
    return FinishedRun(result=result, runner=runner)


def brakes_hold(cell: SimulatedCell) -> bool:
    """Return True if the brakes are on, the command for the brakes is also on, and no motor of the arm has a
    torque command.
    """
    state = cell.truth.states[cell.arm.name]
    assert isinstance(state, ArmState)
    return state.braked and state.command is None and not cell.truth.data.ctrl[cell.arm.motors].any()
