"""Defines the result of a run, a record that is printed as a page or as one JSON object."""

from math import nan
from pathlib import Path
from typing import Any, Final, Literal

import msgspec
from msgspec import UNSET, UnsetType

from handeye.core.errors import BadFile
from handeye.core.files import read_whole
from handeye.core.record import Record
from handeye.core.variation import Seed, WorldSpec
from handeye.judge.finding import Finding, Relation

_LARGEST: Final = 1 << 24  # Bytes: thousands of times the size of a result
Status = Literal["done", "under way", "skipped", "stopped", "not reached", "undone"]
"""Status of a stage."""


class Stage(Record, frozen=True, kw_only=True):
    """A stage of the program. `arm_s` is the simulated time of the stage (s), without the time in which the arm waited
    for the camera.
    """

    name: str
    status: Status
    arm_s: float


class LegResult(Record, frozen=True, kw_only=True):
    """A leg of a relay: the name of its system, its stage, and how the stage has ended."""

    system: str
    stage: str
    ended: Status


class Timing(Record, frozen=True, kw_only=True):
    """Simulated and computing times of a run. Each field has either simulated time or computing time. The working
    phase is the execution of the plan.

    Runs of the same plan in the same world have equal simulated times. Fields that end in `_cpu_s` (CPU seconds) or
    `_wall_s` (wall-clock seconds) are computing times, which differ from run to run. For a resumed run, computing
    times are summed over all sessions.
    """

    friction_s: float
    """Simulated time in which the arm measured the friction of its joints, before the working phase."""
    calibration_s: float
    """Simulated time in which the camera was calibrated, before the working phase."""
    manipulation_s: float
    """Simulated time of the working phase, without the time in which the arm waited for the camera."""
    lens_s: float
    """Simulated time in which the arm waited for the camera to change the lens, to aim, to focus and to take pictures.
    """
    overlapped_s: float
    """Simulated time in which the camera's mechanism and the arm moved at the same time; `manipulation_s` includes
    this time.
    """
    working_s: float
    """Simulated time of the working phase: the sum of `manipulation_s` and `lens_s`."""
    planning_cpu_s: float
    """Computing time for planning; 0 if the plan existed already."""
    vision_cpu_s: float
    run_cpu_s: float
    run_wall_s: float
    """Wall-clock time from the loading of the command, or from the call in Python, to the verdict. It includes the
    time spent waiting for the user.
    """
    real_time_factor: float
    """Simulated seconds, including preparation, per second of `run_wall_s`. This ratio differs from run to run."""
    host_from_step: int
    """Number of steps that were done before the recording of computing times began. If this number is 0, the computing
    times cover the whole run.
    """


class Check(Record, frozen=True, kw_only=True):
    """A finding of the referee as it is stored in a result. Unlike a `Finding`, it includes a sentence."""

    ok: bool
    subject: str
    value: float
    """The measured value. Both `value` and `limit` are in `unit`. JSON has null for a value that is not finite."""
    relation: Relation
    limit: float
    unit: str
    sentence: str
    """The finding as a sentence, without the value."""
    caution: bool = False
    """True if a failed check is only a warning: the work may still be right."""

    @classmethod
    def of(cls, found: Finding) -> "Check":
        """Make a check from a finding."""
        return cls(
            ok=found.ok,
            subject=found.subject,
            value=float(found.value),
            relation=found.relation,
            limit=float(found.limit),
            unit=found.unit,
            sentence=f"{found.subject} ({f'{found.relation} {found.limit:g} {found.unit}'.rstrip()})",
            caution=found.caution,
        )

    @property
    def refuses(self) -> bool:
        """True if the referee rejects the work because of this finding."""
        return not self.ok and not self.caution

    @property
    def told(self) -> str:
        """The finding as a sentence with the measured value."""
        return f"{self.sentence}: {self.value:.3g}"

    def limited(self, limit: float) -> "Check":
        """Return a copy of the finding with another limit. `limit` is in the unit of the finding. If the value is
        beyond `limit`, the copy makes the referee reject the work.
        """
        facts = {name: getattr(self, name) for name in self.__struct_fields__ if name != "sentence"}
        return Check.of(Finding(**facts).limited(limit))


class CameraReport(Record, frozen=True, kw_only=True):
    """The camera of a run: renderer and residuals of the calibration."""

    renderer: str
    sightings_rms_px: dict[str, float]
    """RMS residual of the calibration for each lens, in pixels."""
    residual_in: float | None
    """RMS residual of the calibration on the table, in inches. None if the program takes no picture, so that the
    camera was not calibrated.
    """

    @property
    def used(self) -> bool:
        """True if the camera was calibrated."""
        return self.residual_in is not None


class Result(Record, frozen=True, kw_only=True):
    """The result of a run.

    Runs of the same plan in the same world have equal events, but their results differ in `timing`, which includes
    computing time.
    """

    assembled: bool | None
    """True if the referee accepts the work, False if not; None if the referee has not judged it."""
    completed: bool
    """True if the program ended, or if the arm undid every step that it had to undo."""
    paused: bool
    """True if the run has not ended: you paused it, it was interrupted, or it is still in progress."""
    stopped_at: str | None
    error: int | None
    message: str
    interventions: tuple[str, ...]
    """Interventions of the operator and the user, one sentence each."""
    stages: tuple[Stage, ...]
    timing: Timing
    referee: dict[str, Check]
    """Findings of the referee by name; empty if the referee has not judged the run (see `message`)."""
    task: str
    program: str
    seed: Seed
    world: WorldSpec
    camera: CameraReport
    versions: dict[str, str]
    warnings: tuple[str, ...] = ()
    """Reasons to doubt the result, one sentence each."""
    limits: dict[str, float] | UnsetType = UNSET
    """Limits given in place of the referee's own. The keys are the names of the findings."""
    replaced: dict[str, str] | UnsetType = UNSET
    """The parts that the caller replaced with Python code. The keys are the parts; the values name the code."""
    without: tuple[str, ...] | UnsetType = UNSET
    """Senses that were switched off in the program."""
    apart: bool | UnsetType | None = UNSET
    """Set only for a run that undid its work. True if the referee finds every part back in its place; None if the
    referee has not judged the run, or if only a part of the work was undone.
    """
    figures: dict[str, float] | UnsetType = UNSET
    """Further figures of the run, which only its system measures. The keys are the names of the figures."""
    built: dict[str, Check] | UnsetType = UNSET
    """Findings on the finished work of a job that then undid its work. `referee` has the findings on the state after
    the undoing.
    """
    legs: tuple[LegResult, ...] | UnsetType = UNSET
    """The legs of a relay, in order; set only if the run is a relay."""

    @property
    def judged(self) -> bool | None:
        """The referee's verdict: True if all work that the referee judged (assembly, undoing or both) is right. None
        if the referee has not judged the run.
        """
        words = [word for word in (self.assembled, self.apart) if isinstance(word, bool)]
        return all(words) if words else None

    @property
    def checks(self) -> tuple[Check, ...]:
        """All findings of the referee. Findings on the assembly come before findings on the undoing."""
        return (*(self.built or {}).values(), *self.referee.values())

    @property
    def cautions(self) -> tuple[str, ...]:
        """One sentence for each finding that is only a warning. The referee does not reject the work because of
        warnings.
        """
        return tuple(check.told for check in self.checks if not check.ok and check.caution)

    @property
    def exit_code(self) -> int:
        """Exit code of the command: 0 for success, 1 if the program called the operator, and 3 if the program
        reported success but the referee disagrees.
        """
        if self.paused:
            return 0
        if not self.completed:
            return 1
        return 3 if self.judged is False else 0


def to_json(result: Result, *, line: bool = False) -> bytes:
    """Encode the result as one JSON object with a final newline. The JSON text is indented or, if `line` is True, on
    one line.
    """
    encoded = msgspec.json.encode(result)
    return (encoded if line else msgspec.json.format(encoded, indent=1)) + b"\n"


def read_result(path: Path) -> Result:
    """Read a result from a file. Raises InvalidInput if the file cannot be read, or is not a result."""
    try:
        written = msgspec.json.decode(read_whole(path, _LARGEST))
        for name in ("referee", "built") if isinstance(written, dict) else ():
            restore_figures(written.get(name))
        return msgspec.convert(written, Result)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{path} is not the result of a run: {error}") from None


def restore_figures(findings: Any) -> None:
    """Replace null by NaN in the figures of findings. JSON cannot store values that are not finite, so a result has
    null instead.
    """
    for check in findings.values() if isinstance(findings, dict) else ():
        for name in ("value", "limit"):
            if isinstance(check, dict) and name in check and check[name] is None:
                check[name] = nan


def told_limits(result: Result) -> tuple[str, ...]:
    """Return the limits that the calling program set. If the referee measured the quantity of a limit, the text of
    this limit also gives the quantity and its unit.
    """
    checks = {**result.referee, **(result.built or {})}
    return tuple(
        f"{name}: {limit:g}"
        if (check := checks.get(name)) is None
        else f"{check.subject}: {check.relation} {limit:g} {check.unit}"
        for name, limit in (result.limits or {}).items()
    )
