"""The result of a run: one record, printed as a page or as one JSON object."""

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

_LARGEST: Final = 1 << 24  # Bytes: thousands of times what a result has
Status = Literal["done", "under way", "skipped", "stopped", "not reached", "undone"]
"""Status of a stage."""


class Stage(Record, frozen=True, kw_only=True):
    """A stage of the program; `arm_s` is simulated seconds without those in which the arm waited for the camera."""

    name: str
    status: Status
    arm_s: float


class Timing(Record, frozen=True, kw_only=True):
    """Times of a run, simulated and computing; no field adds one to the other.

    Equal runs have equal simulated seconds. Fields that end in `_cpu_s` (CPU seconds) or `_wall_s` (wall-clock
    seconds) are computing time, differ each time, and are summed over all sessions of a resumed run.
    """

    friction_s: float
    """Simulated: the arm measured the friction of its joints, before the working phase."""
    calibration_s: float
    """Simulated: the camera was calibrated, before the working phase."""
    manipulation_s: float
    """Simulated: the working phase without the time in which the arm waited for the camera."""
    lens_s: float
    """Simulated: the arm waited for lens change, aim, focus and pictures."""
    overlapped_s: float
    """Simulated: in addition, the camera's mechanism was busy while the arm moved."""
    working_s: float
    """Simulated: the working phase, which is manipulation and lens."""
    planning_cpu_s: float
    """0: the plan existed already."""
    vision_cpu_s: float
    run_cpu_s: float
    run_wall_s: float
    """From when the command was loaded, or the call from Python, to the verdict; including waiting for the user."""
    real_time_factor: float
    """Simulated seconds, including set-up, per second of `run_wall_s`; differs each time."""
    host_from_step: int
    """Steps done before computing time was counted; 0: it covers the whole run."""


class Check(Record, frozen=True, kw_only=True):
    """One finding of the referee, as results keep it: a `Finding` with its sentence."""

    ok: bool
    subject: str
    value: float
    """In `unit`, as `limit`; null in JSON: it is not finite."""
    relation: Relation
    limit: float
    unit: str
    sentence: str
    """The finding as a sentence, without the value."""
    caution: bool = False
    """If not `ok`, this is only a warning: the work may still be right."""

    @classmethod
    def of(cls, found: Finding) -> "Check":
        """A finding with its sentence."""
        return cls(
            ok=found.ok,
            subject=found.subject,
            value=float(found.value),
            relation=found.relation,
            limit=float(found.limit),
            unit=found.unit,
            sentence=f"{found.subject} ({found.relation} {found.limit:g} {found.unit})",
            caution=found.caution,
        )

    @property
    def refuses(self) -> bool:
        """True if it makes the work wrong."""
        return not self.ok and not self.caution

    @property
    def told(self) -> str:
        """The finding as a sentence."""
        return f"{self.sentence}: {self.value:.3g}"

    def limited(self, limit: float) -> "Check":
        """The same measurement with another limit, in the same unit; beyond it, the work is wrong."""
        facts = {name: getattr(self, name) for name in self.__struct_fields__ if name != "sentence"}
        return Check.of(Finding(**facts).limited(limit))


class CameraReport(Record, frozen=True, kw_only=True):
    """Report on the camera: renderer and calibration."""

    renderer: str
    sightings_rms_px: dict[str, float]
    """Residual for each lens."""
    residual_in: float | None
    """On the table, inches; None if the program takes no picture and did not calibrate."""

    @property
    def used(self) -> bool:
        """True if it was calibrated."""
        return self.residual_in is not None


class Result(Record, frozen=True, kw_only=True):
    """Result of a run.

    Equal runs have equal `events`. Their results differ, because `timing` includes computing time.
    """

    assembled: bool | None
    """The referee's verdict; None if the referee was not asked."""
    completed: bool
    """The program ended, or the arm finished undoing what it was asked to."""
    paused: bool
    """The run is before its end: paused on request, interrupted, or running."""
    stopped_at: str | None
    error: int | None
    message: str
    interventions: tuple[str, ...]
    """Interventions in the run, a sentence each."""
    stages: tuple[Stage, ...]
    timing: Timing
    referee: dict[str, Check]
    """Findings by name; empty if the referee was not asked or the program did not end: see `message`."""
    task: str
    program: str
    seed: Seed
    world: WorldSpec
    camera: CameraReport
    versions: dict[str, str]
    warnings: tuple[str, ...] = ()
    """Reasons to doubt the result, a sentence each."""
    limits: dict[str, float] | UnsetType = UNSET
    """Limits given in place of the referee's own, by the names of its findings."""
    replaced: dict[str, str] | UnsetType = UNSET
    """Parts replaced by the caller's code, with the names of that code."""
    without: tuple[str, ...] | UnsetType = UNSET
    """Senses that the program did without."""
    apart: bool | UnsetType | None = UNSET
    """After a reversal: the referee's verdict whether every part is back in place; None: not asked, or not everything
    is undone.
    """
    built: dict[str, Check] | UnsetType = UNSET
    """Findings on a job's work before the job undid it; `referee` has those after."""

    @property
    def judged(self) -> bool | None:
        """The referee's verdict on what was built, taken apart, or both; None if the referee was not asked."""
        words = [word for word in (self.assembled, self.apart) if isinstance(word, bool)]
        return all(words) if words else None

    @property
    def checks(self) -> tuple[Check, ...]:
        """All findings of the referee, those on what was built first."""
        return (*(self.built or {}).values(), *self.referee.values())

    @property
    def cautions(self) -> tuple[str, ...]:
        """The referee's warnings, which do not make the work wrong, a sentence each."""
        return tuple(check.told for check in self.checks if not check.ok and check.caution)

    @property
    def exit_code(self) -> int:
        """0 assembled, 1 the program called the operator, 3 the program reported success and the referee disagrees."""
        if self.paused:
            return 0
        if not self.completed:
            return 1
        return 3 if self.judged is False else 0


def to_json(result: Result, *, line: bool = False) -> bytes:
    """The result as one JSON object, indented or on one `line`, with a final newline."""
    encoded = msgspec.json.encode(result)
    return (encoded if line else msgspec.json.format(encoded, indent=1)) + b"\n"


def read_result(path: Path) -> Result:
    """The result in a file; raises InvalidInput if it cannot be read, or is no result."""
    try:
        written = msgspec.json.decode(read_whole(path, _LARGEST))
        for name in ("referee", "built") if isinstance(written, dict) else ():
            restore_figures(written.get(name))
        return msgspec.convert(written, Result)
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{path} is not the result of a run: {error}") from None


def restore_figures(findings: Any) -> None:
    """Set figures of findings to NaN where JSON has null, which means a value that is not finite."""
    for check in findings.values() if isinstance(findings, dict) else ():
        for name in ("value", "limit"):
            if isinstance(check, dict) and name in check and check[name] is None:
                check[name] = nan
