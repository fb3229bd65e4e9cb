"""One whole run: a drawn world, a calibrated camera, a plan carried out, a referee's verdict."""

import platform
import time
from collections.abc import Callable
from dataclasses import dataclass, field
from importlib.metadata import version as installed
from typing import Final

from handeye import __version__
from handeye.arm.model import ArmModel, digest
from handeye.arm.stanford import STANFORD
from handeye.cell.imperfection import World
from handeye.cell.simulated import SimulatedCell, SimulationError
from handeye.errors import InvalidInput
from handeye.judge.referee import assembled, judge
from handeye.plan.plan import Plan
from handeye.plan.program import Look
from handeye.report.result import CameraReport, Check, Result, Stage, Timing
from handeye.units import INCH
from handeye.vision.calibration import Calibration
from handeye.vision.camera import DRAWING
from handeye.work.calibration import LAST_LENS, CalibrationFailed, calibrate_camera
from handeye.work.events import Event, StageFinished, StageStarted
from handeye.work.executor import Executor
from handeye.work.run import Run

ARMS: Final = {STANFORD.name: STANFORD}


@dataclass(slots=True, kw_only=True)
class _Stopwatch:
    """Arm time of each stage, from the events and the camera's share of the clock."""

    run: Run | None = None
    started: tuple[float, float] = (0.0, 0.0)
    seconds: dict[str, tuple[str, float]] = field(default_factory=dict)

    def __call__(self, event: Event) -> None:
        assert self.run is not None
        if isinstance(event, StageStarted):
            self.started = (event.time, self.run.clockwork.lens)
        elif isinstance(event, StageFinished):
            busy = self.run.clockwork.lens - self.started[1]
            _, before = self.seconds.get(event.stage, ("", 0.0))
            self.seconds[event.stage] = (event.status, before + event.time - self.started[0] - busy)


@dataclass(frozen=True, slots=True, kw_only=True)
class Finished:
    """A run that has ended: what it came to, what it remembers, and the cell as it was left."""

    result: Result
    run: Run
    cell: SimulatedCell


def run_plan(
    plan: Plan,
    *,
    seed: int,
    camera: str = "auto",
    planning_wall_s: float = 0.0,
    referee: bool = True,
    listeners: tuple[Callable[[Event], None], ...] = (),
) -> Finished:
    """Carry out a plan in the world of a seed and have it judged.

    Raises:
        InvalidInput: the plan is for another arm, or the camera cannot work as asked.
    """
    arm = ARMS.get(plan.arm)
    if arm is None or digest(arm) != plan.arm_digest:
        raise InvalidInput(
            f"the plan was made for another arm ({plan.arm}, {plan.arm_digest}); plan it again"
        )
    begun = time.perf_counter()
    cell = SimulatedCell(World.sample(seed), camera=camera)
    calibration, trouble = _calibrated(cell, arm, plan)
    stages = _Stopwatch()

    def emit(event: Event) -> None:
        stages(event)
        for listener in listeners:
            listener(event)

    run = Run(
        plan=plan,
        arm=arm,
        cell=cell,
        camera=calibration.model if calibration else DRAWING,
        emit=emit,
        stopwatch=time.process_time,
    )
    if calibration is not None:
        run.lens = LAST_LENS
    stages.run = run
    simulated = run.time
    executor = Executor(state=run)
    try:
        completed = trouble is None and executor.run()
    except SimulationError as error:
        completed, trouble = False, str(error)
    findings = judge(cell.truth) if completed and referee else {}
    wall = time.perf_counter() - begun
    stopped = executor.stopped
    names = plan.program.stages
    result = Result(
        assembled=None if not referee else completed and assembled(findings),
        completed=completed,
        stopped_at=names[executor.stage] if not completed and executor.stage is not None else None,
        error=stopped.error if stopped else None,
        message=trouble or (stopped.message if stopped else "the program came to its end"),
        stages=tuple(_stage(name, stages) for name in names),
        timing=_timing(run, run.time - simulated, wall, planning_wall_s),
        referee={
            name: Check(ok=f.ok, value=f.value, limit=f.limit, unit=f.unit, sentence=f.sentence)
            for name, f in findings.items()
        },
        seed=seed,
        camera=_camera(cell, calibration),
        versions=versions(),
    )
    return Finished(result=result, run=run, cell=cell)


def _calibrated(cell: SimulatedCell, arm: ArmModel, plan: Plan) -> tuple[Calibration | None, str | None]:
    """The calibration of the camera, if the plan looks at all, or why there is none."""
    if not any(isinstance(step.operation, Look) for step in plan.program.steps):
        return None, None
    try:
        return calibrate_camera(cell, arm, DRAWING), None
    except (CalibrationFailed, SimulationError) as error:
        return None, str(error)


def _stage(name: str, stages: _Stopwatch) -> Stage:
    status, seconds = stages.seconds.get(name, ("not reached", 0.0))
    return Stage(name=name, status=status, arm_s=round(seconds, 3))


def _timing(run: Run, simulated: float, wall: float, planning: float) -> Timing:
    lens, vision = run.clockwork.lens, run.clockwork.vision
    return Timing(
        planning_wall_s=planning,
        manipulation_s=round(simulated - lens, 3),
        lens_s=round(lens, 3),
        vision_wall_s=vision,
        total_s=round(simulated + vision, 3),
        wall_s=wall,
        real_time_factor=run.time / wall if wall > 0 else 0.0,
    )


def _camera(cell: SimulatedCell, calibration: Calibration | None) -> CameraReport:
    if calibration is None:
        return CameraReport(renderer=cell.camera.renderer, sightings_rms_px={}, residual_in=None)
    residuals = {f"{lens * 1000:.0f} mm": rms for lens, rms in calibration.residual_px.items()}
    return CameraReport(
        renderer=cell.camera.renderer,
        sightings_rms_px=residuals,
        residual_in=calibration.residual_m / INCH,
    )


def versions() -> dict[str, str]:
    """What a result depends on."""
    packages = ("mujoco", "numpy", "scipy", "opencv-python-headless")
    found = {name: installed(name) for name in packages}
    return {"handeye": __version__, "python": platform.python_version(), **found}
