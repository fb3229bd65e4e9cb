"""Results of runs that were never executed."""

from handeye.core.variation import WorldSpec
from handeye.results.result import CameraReport, Check, Result, Timing


def result(
    *,
    completed: bool,
    assembled: bool | None,
    message: str = "",
    checks: dict[str, Check] | None = None,
    program: str = "water_pump",
    planning: float = 0.0,
    factor: float = 1.0,
    friction: float = 0.0,
    calibration: float = 0.0,
    from_step: int = 0,
) -> Result:
    return Result(
        assembled=assembled, completed=completed, paused=False, interventions=(),
        stopped_at=None if completed else "check the gasket",
        error=None if completed else 32, message=message, stages=(), referee=checks or {}, program=program,
        task="water_pump", seed=0, world=WorldSpec(seed=0), versions={},
        timing=Timing(
            friction_s=friction, calibration_s=calibration, manipulation_s=0, lens_s=0, overlapped_s=0, working_s=0,
            planning_cpu_s=planning,
            vision_cpu_s=0, run_cpu_s=1, run_wall_s=1, real_time_factor=factor, host_from_step=from_step,
        ),
        camera=CameraReport(renderer="ray casting", sightings_rms_px={}, residual_in=None),
    )  # fmt: skip
