"""Makes the result of a run from the run's events."""

from collections.abc import Iterable, Iterator, Sequence

from msgspec import UNSET

from handeye.core.units import INCH
from handeye.core.versions import versions
from handeye.judge.finding import Findings, all_right
from handeye.ports.camera import Renderer
from handeye.program.events import (
    AnyEvent,
    CameraBusy,
    CameraStarted,
    ExperimentMade,
    FrictionMeasured,
    GuardFaint,
    LineTyped,
    OperatorAnswered,
    PeriodsCommanded,
    RunStarted,
    StageFinished,
    StageStarted,
    StageUndone,
    StepStarted,
    UndoOrdered,
)
from handeye.program.senses import assumption
from handeye.results.pauses import pause_sentence
from handeye.results.result import CameraReport, Check, LegResult, Result, Stage, Status, Timing
from handeye.runs.advance import Pause
from handeye.runs.host_seconds import HostSeconds
from handeye.runs.runner import Runner
from handeye.trace.sentences import renderer_name, sentence
from handeye.vision.calibration import Calibration


def summary(
    runner: Runner, pause: Pause, *, findings: Findings | None, built: Findings, host: HostSeconds
) -> Result:
    """Make the result of a run. `built` has the referee's findings on the finished work, measured before the arm undid
    the work.
    """
    completed = pause.kind == "end"
    names = runner.listing.stages
    cell = runner.system.cell
    renderer = Renderer(method="none") if cell is None else cell.renderer
    stages = stage_times(names, runner.events)
    ended = {stage.name: stage.status for stage in stages}
    legs = tuple(
        LegResult(system=system, stage=stage, ended=ended[stage]) for system, stage in runner.system.legs
    )
    return Result(
        legs=legs or UNSET,
        assembled=_assembled(runner, findings, built, completed=completed),
        apart=(all_right(findings) if findings else None) if runner.undone else UNSET,
        completed=completed,
        paused=pause.kind == "break",
        stopped_at=names[runner.stage] if not completed and runner.stage is not None else None,
        error=pause.error,
        message=pause_sentence(pause),
        interventions=tuple(interventions(runner.events)),
        warnings=tuple(warnings(runner.events)),
        stages=stages,
        timing=timing(runner.events, runner.time, host),
        referee=_checks(findings or {}),
        built=_checks(built) if built else UNSET,
        task=runner.setup.task,
        program=runner.listing.name,
        seed=runner.setup.world.seed,
        world=runner.setup.world,
        camera=camera_report(renderer, runner.kind.calibration(runner.system.state)),
        versions=versions(),
    )


def _assembled(runner: Runner, findings: Findings | None, built: Findings, *, completed: bool) -> bool | None:
    """Return the verdict on the assembly; None if the referee has not judged the assembly, or if the work was undone
    without a verdict.
    """
    if runner.undone:
        return all_right(built) if built else None
    return None if findings is None else completed and all_right(findings)


def _checks(findings: Findings) -> dict[str, Check]:
    return {name: Check.of(finding) for name, finding in findings.items()}


def interventions(events: Sequence[AnyEvent]) -> Iterable[str]:
    """Yield one sentence for each intervention of a person in the run."""
    for event in events:
        when = f"at {event.time:.1f} s"
        if isinstance(event, OperatorAnswered):
            yield f"{when} the operator chose: {event.choice}"
        elif isinstance(event, LineTyped | PeriodsCommanded) or (
            isinstance(event, UndoOrdered) and event.asked_by == "person"
        ):
            yield f"{when} {sentence(event)}"
        elif isinstance(event, ExperimentMade):
            yield f"{when} {event.what} {event.name} was set by the experimenter"


def warnings(events: Iterable[AnyEvent]) -> Iterator[str]:
    """Yield reasons to doubt the result of a run, one sentence each."""
    place = ""
    for event in events:
        if isinstance(event, RunStarted):
            yield from (f"without {sense}: {assumption(sense)}" for sense in event.lacking)
        elif isinstance(event, StepStarted):
            place = event.place
        elif isinstance(event, GuardFaint):
            yield f"line {place}: {sentence(event)}"


def stage_times(names: tuple[str, ...], events: Iterable[AnyEvent]) -> tuple[Stage, ...]:
    """Return the status and the arm time of each stage. Arm time is simulated time (s), without the time in
    which the arm waited for the camera's mechanism."""
    seconds = dict.fromkeys(names, 0.0)
    status: dict[str, Status] = dict.fromkeys(names, "not reached")
    here, begun, busy, now = "", 0.0, 0.0, 0.0
    for event in events:
        now = event.time
        if isinstance(event, StageStarted):
            here, begun, busy = event.stage, event.time, 0.0
            status[here] = "under way"
        elif isinstance(event, CameraBusy):
            busy += event.seconds
        elif isinstance(event, StageFinished):
            if here == event.stage:  # if not, the stage was done earlier, and the arm was undoing it
                seconds[here] += event.time - begun - busy
            status[event.stage], here = event.status, ""
        elif isinstance(event, StageUndone):
            status[event.stage], here = "undone", ""
    if here:
        seconds[here] += now - begun - busy
    return tuple(Stage(name=name, status=status[name], arm_s=round(seconds[name], 3)) for name in names)


def timing(events: Sequence[AnyEvent], clock: float, host: HostSeconds) -> Timing:
    """Return the times of a run, computed from its events so far. `clock` is the present time of the cell (s)."""
    prepared = sum((event.prepared for event in events if isinstance(event, RunStarted)), 0.0)
    friction = sum((event.seconds for event in events if isinstance(event, FrictionMeasured)), 0.0)
    lens = sum((event.seconds for event in events if isinstance(event, CameraBusy)), 0.0)
    covered = max(clock - host.from_clock_s, 0.0)
    return Timing(
        friction_s=round(friction, 3),
        calibration_s=round(prepared - friction, 3),
        manipulation_s=round(clock - lens, 3),
        lens_s=round(lens, 3),
        overlapped_s=round(overlapped(events, clock), 3),
        working_s=round(clock, 3),
        planning_cpu_s=host.planning_cpu_s,
        vision_cpu_s=host.vision_cpu_s,
        run_cpu_s=host.run_cpu_s,
        run_wall_s=host.run_wall_s,
        real_time_factor=round(covered / host.run_wall_s, 3) if host.run_wall_s > 0 else 0.0,
        host_from_step=host.from_step,
    )


def overlapped(events: Iterable[AnyEvent], clock: float) -> float:
    """Return the time (s) during which the camera's mechanism was busy while the arm did not wait for the mechanism.
    Only the time before `clock` (s) counts.
    """
    ready = busy = 0.0
    for event in events:
        if isinstance(event, CameraStarted):
            ready = max(ready, event.time) + event.seconds
            busy += event.seconds
        elif isinstance(event, CameraBusy) and event.action == "wait":
            busy -= event.seconds
    return max(busy - max(ready - clock, 0.0), 0.0)


def camera_report(renderer: Renderer, calibration: Calibration | None) -> CameraReport:
    """Report on a camera. If the camera is calibrated, the report includes the residuals of the calibration."""
    residuals = {} if calibration is None else calibration.residual_px
    return CameraReport(
        renderer=renderer_name(renderer),
        sightings_rms_px={f"{lens * 1000:.0f} mm": rms for lens, rms in residuals.items()},
        residual_in=None if calibration is None else calibration.residual_m / INCH,
    )
