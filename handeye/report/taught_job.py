"""A job that is taught: carried out, undone, and judged after both."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

from handeye.judge.finding import Findings, all_right
from handeye.plain_text import counted
from handeye.record import Record
from handeye.report.judging import findings
from handeye.report.result import Check
from handeye.runs.advance import Pause, advance
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.taught.system import TAUGHT, TaughtSystem
from handeye.tasks.benches import JobName, Lying, TaughtJob, TaughtPlan, job_script
from handeye.trig.cursor_commands import told_run
from handeye.trig.reports import Way
from handeye.trig.running import Ran
from handeye.variation import WorldSpec

Outcome = Literal["right", "stopped", "silent", "halted"]
"""All as it should be; the program or the arm stopped before; done, and the referee disagrees; somebody's key."""

When = Literal["taught", "run", "undone"]


class JobReport(Record, frozen=True, kw_only=True):
    """What came of a job."""

    job: JobName
    seed: int
    """Of its world."""
    blocks: int | None = None
    interrupted_after: int | None = None
    """Steps after which it was to be undone."""
    outcome: Outcome
    forward: Way | None = None
    back: Way | None = None
    checks: Mapping[str, Check] = {}
    """Of the referee, when the program had ended."""
    checks_back: Mapping[str, Check] = {}
    """When it was undone."""
    goals: tuple[tuple[float, float], ...] = ()
    """Where the referee wants blocks laid by the program, mm, in the order in which they are taken."""
    lying: Mapping[When, tuple[Lying, ...]] = {}
    """How the blocks truly lay, in that order: when the job had been taught, when the program had come as far as it
    came, and when it was undone as far as that went."""
    told: tuple[str, ...] = ()
    """How both ways have ended, in words."""
    ended_s: float | None = None
    """When the program had come as far as it came, by the arm's clock."""
    arm_s: float = 0.0
    """Of the arm's clock, teaching included."""

    @property
    def wrong(self) -> tuple[Check, ...]:
        """What the referee disagrees with."""
        return tuple(check for check in (*self.checks.values(), *self.checks_back.values()) if check.refuses)


def setup_of_job(name: JobName, seed: int, blocks: int | None) -> Checkpoint:
    """A run of a job that has not begun; `blocks` are those of the palletiser's stack."""
    plan = TaughtPlan(job=name, script=job_script(name, blocks or 0))
    setup = Setup(
        system=TAUGHT.name, plan=plan, world=WorldSpec(seed=seed), camera="auto", task=name, judged=True
    )
    return Checkpoint(setup=setup)


def job_of(runner: Runner) -> TaughtJob:
    """The job that a run carries out."""
    assert isinstance(runner.system, TaughtSystem)
    return runner.system.job


@dataclass(frozen=True, slots=True, kw_only=True)
class Carried:
    """A job that was carried out."""

    report: JobReport
    pause: Pause
    """How its run stands."""


def carry_out(
    runner: Runner,
    *,
    blocks: int | None,
    after: int | None = None,
    tell: Callable[[str], None] = lambda _: None,
) -> Carried:
    """Carry out a job that has been taught, undo it, and ask the referee after both.

    Args:
        after: steps after which it is undone; None: it comes to its end.
        tell: is told how either way has ended.
    """
    assert isinstance(runner.system, TaughtSystem)
    system, job = runner.system, runner.system.job
    told: list[str] = []
    lying: dict[When, tuple[Lying, ...]] = {"taught": job.lying()}
    forward = back = ended = None
    placed: Findings = {}
    apart: Findings = {}

    def way(pause: Pause, steps: int, *, undoing: bool) -> Way | None:
        """How one way has ended; None: the arm refused a step."""
        obstacle = system.state.obstacle
        if pause.kind in ("operator", "trouble") and obstacle is None:
            told.append(pause.message)
            return None
        ran = Ran(steps=steps, end=_end(pause, undoing=undoing), obstacle=obstacle)
        told.append(_told(ran, undoing=undoing))
        tell(told[-1])
        return Way(steps=ran.steps, end=ran.end, obstacle=ran.obstacle)

    def carried(outcome: Outcome, pause: Pause) -> Carried:
        report = JobReport(
            job=runner_job(runner), seed=runner.setup.world.seed, blocks=blocks, interrupted_after=after,
            outcome=outcome, forward=forward, back=back, checks=_checks(placed), checks_back=_checks(apart),
            told=tuple(told), arm_s=round(runner.time, 6), ended_s=ended, goals=job.goals, lying=lying,
        )  # fmt: skip
        return Carried(report=report, pause=pause)

    pause = advance(runner, steps=after)
    done = len(system.executed)
    forward, lying["run"], ended = way(pause, done, undoing=False), job.lying(), round(runner.time, 6)
    if pause.kind not in ("end", "break"):
        return carried("halted" if pause.kind == "panic" else "stopped", pause)
    placed = findings(runner, pause)
    if not job.undoable:
        return carried("right" if all_right(placed) else "silent", pause)
    runner.have_undone(0, halts=True)
    pause = advance(runner)
    back, lying["undone"] = way(pause, done - len(system.executed), undoing=True), job.lying()
    if pause.kind != "end":
        return carried("halted" if pause.kind == "panic" else "stopped", pause)
    apart = {**findings(runner, pause), **job.remembered()}
    right = all_right(apart) and (not placed or all_right(placed))
    return carried("right" if right else "silent", pause)


def runner_job(runner: Runner) -> JobName:
    """The name of the job that a run carries out."""
    assert isinstance(runner.setup.plan, TaughtPlan)
    return runner.setup.plan.job


def _end(pause: Pause, *, undoing: bool) -> Literal["count", "none", "halted", "beginning", "stopped"]:
    match pause.kind:
        case "panic":
            return "halted"
        case "operator" | "trouble":
            return "stopped"
        case "end":
            return "beginning" if undoing else "none"
    return "count"


def _told(ran: Ran, *, undoing: bool) -> str:
    """How a way has ended; of one that was interrupted nobody can go on by a command of TRIG."""
    if ran.end == "halted":
        return f"{counted(ran.steps, 'step')} {'undone' if undoing else 'done'}; interrupted"
    return told_run(ran, back=undoing)


def _checks(findings: Findings) -> dict[str, Check]:
    return {name: Check.of(finding) for name, finding in findings.items()}
