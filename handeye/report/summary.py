"""The result of a run, from what happened in it."""

from collections.abc import Iterable

from handeye.events import (
    AnyEvent,
    CameraBusy,
    ExperimentMade,
    OperatorAnswered,
    RunStarted,
    StageFinished,
    StageStarted,
)
from handeye.judge.finding import Finding, Findings, all_right
from handeye.report.pauses import pause_sentence
from handeye.report.result import CameraReport, Check, Result, Stage, Timing
from handeye.runs.advance import Pause
from handeye.runs.programs import context_of
from handeye.runs.runner import Runner
from handeye.trace.sentences import renderer_name
from handeye.units import INCH
from handeye.versions import versions


def summary(
    runner: Runner, pause: Pause, *, findings: Findings | None, wall: float, planning: float
) -> Result:
    """Summarize a run.

    Args:
        findings: the referee's; None if nobody was asked.
        wall: seconds of this computer's clock since the run was begun or taken up.
        planning: seconds of its processor for the planning phase.
    """
    completed = pause.kind == "end"
    names = runner.stages
    checks = {name: _check(finding) for name, finding in (findings or {}).items()}
    return Result(
        assembled=None if findings is None else completed and all_right(findings),
        completed=completed,
        paused=pause.kind == "break",
        stopped_at=names[runner.stage] if not completed and runner.stage is not None else None,
        error=pause.error,
        message=pause_sentence(pause),
        interventions=tuple(interventions(runner.events)),
        stages=stage_times(names, runner.events),
        timing=_timing(runner, wall, planning),
        referee=checks,
        task=runner.setup.task,
        program=runner.listing.name,
        seed=runner.setup.world.seed,
        world=runner.setup.world,
        camera=_camera(runner),
        versions=versions(),
    )


def _check(found: Finding) -> Check:
    """A finding with the sentence that tells of it."""
    return Check(
        ok=found.ok,
        subject=found.subject,
        value=found.value,
        relation=found.relation,
        limit=found.limit,
        unit=found.unit,
        sentence=f"{found.subject} ({found.relation} {found.limit:g} {found.unit})",
    )


def interventions(events: Iterable[AnyEvent]) -> Iterable[str]:
    """Tell what somebody did to the run, a sentence each."""
    for event in events:
        if isinstance(event, OperatorAnswered):
            yield f"at {event.time:.1f} s the operator chose: {event.choice}"
        elif isinstance(event, ExperimentMade):
            yield f"at {event.time:.1f} s {event.what} {event.name} was set by hand"


def stage_times(names: tuple[str, ...], events: Iterable[AnyEvent]) -> tuple[Stage, ...]:
    """Status and arm time of each stage: simulated seconds without those of the camera's mechanism."""
    seconds = dict.fromkeys(names, 0.0)
    status = dict.fromkeys(names, "not reached")
    here, begun, busy, now = "", 0.0, 0.0, 0.0
    for event in events:
        now = event.time
        if isinstance(event, StageStarted):
            here, begun, busy = event.stage, event.time, 0.0
            status[here] = "under way"
        elif isinstance(event, CameraBusy):
            busy += event.seconds
        elif isinstance(event, StageFinished):
            seconds[event.stage] += event.time - begun - busy
            status[event.stage] = event.status
            here = ""
    if here:
        seconds[here] += now - begun - busy
    return tuple(Stage(name=name, status=status[name], arm_s=round(seconds[name], 3)) for name in names)


def _timing(runner: Runner, wall: float, planning: float) -> Timing:
    begun = next((e.time for e in runner.events if isinstance(e, RunStarted)), runner.time)
    lens = sum(event.seconds for event in runner.events if isinstance(event, CameraBusy))
    simulated, vision = runner.time - begun, runner.vision.seconds
    return Timing(
        planning_wall_s=planning,
        manipulation_s=round(simulated - lens, 3),
        lens_s=round(lens, 3),
        vision_wall_s=vision,
        total_s=round(simulated + vision, 3),
        wall_s=wall,
        real_time_factor=(runner.time - runner.started) / wall if wall > 0 else 0.0,
    )


def _camera(runner: Runner) -> CameraReport:
    if runner.system.cell is None:
        return CameraReport(renderer="none", sightings_rms_px={}, residual_in=None)
    renderer, calibration = renderer_name(runner.cell.renderer), context_of(runner.system).state.calibration
    if calibration is None:
        return CameraReport(renderer=renderer, sightings_rms_px={}, residual_in=None)
    residuals = {f"{lens * 1000:.0f} mm": rms for lens, rms in calibration.residual_px.items()}
    return CameraReport(
        renderer=renderer, sightings_rms_px=residuals, residual_in=calibration.residual_m / INCH
    )
