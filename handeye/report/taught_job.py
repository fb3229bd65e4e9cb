"""A job that was taught: carried out, undone, and judged after both."""

from collections.abc import Mapping
from typing import Final, Literal

from handeye.errors import InvalidInput
from handeye.judge.finding import Findings, all_right
from handeye.record import Record
from handeye.report.result import Check
from handeye.tasks.benches import JobName, Lying, TaughtJob
from handeye.trig.cursor_commands import told_run
from handeye.trig.desk import Desk
from handeye.trig.reports import Way
from handeye.trig.running import Ran

ALL: Final = 1_000_000_000
"""Steps: more than are ever remembered."""
Outcome = Literal["right", "stopped", "silent", "halted"]
"""All as it should be; the program or the arm stopped before; done, and the referee disagrees; somebody's key."""

When = Literal["taught", "run", "undone"]


class JobReport(Record, frozen=True, kw_only=True):
    """What came of a job."""

    job: JobName
    seed: int | None
    """Of its world; None: the one without errors."""
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


def carry_out(
    job: TaughtJob,
    name: JobName,
    desk: Desk,
    *,
    seed: int | None,
    blocks: int | None,
    after: int | None = None,
) -> JobReport:
    """Carry out a job that has been taught, undo it, and ask the referee after both.

    Args:
        desk: whose key stops the arm, and who is told.
        after: steps after which it is undone, as if somebody had struck a key; None: it comes to its end.
    """
    session = job.session
    session.desk = desk
    told: list[str] = []

    def tell(ran: Ran, *, back: bool = False) -> Way:
        told.append(told_run(ran, back=back))
        desk.tell(told[-1])
        return Way(steps=ran.steps, end=ran.end, obstacle=ran.obstacle)

    def end(outcome: Outcome, forward: Way | None = None, back: Way | None = None) -> JobReport:
        return JobReport(
            job=name, seed=seed, blocks=blocks, interrupted_after=after, outcome=outcome, forward=forward, back=back,
            checks=_checks(placed), checks_back=_checks(apart), told=tuple(told), arm_s=round(job.bench.now, 6),
            ended_s=ended, goals=job.goals, lying=lying,
        )  # fmt: skip

    lying: dict[When, tuple[Lying, ...]] = {"taught": job.lying()}
    ended: float | None = None
    forward: Way | None = None
    placed: Findings = {}
    apart: Findings = {}
    try:
        ran = session.runner.run() if after is None else _first_steps(job, after)
        forward, lying["run"], ended = tell(ran), job.lying(), round(job.bench.now, 6)
        if ran.end == "halted":
            return end("halted", forward)
        if ran.end == "none":
            placed = job.findings()
        wanted = job.findings_back()
        if wanted is None:
            return end("right" if all_right(placed) else "silent", forward)
        ran = session.runner.back(ALL)
        back, lying["undone"] = tell(ran, back=True), job.lying()
    except InvalidInput as error:  # by the arm: it cannot go where a step wants it
        told.append(str(error))
        lying["run" if forward is None else "undone"] = job.lying()
        return end("stopped", forward)
    if ran.end != "beginning":
        return end("halted" if ran.end == "halted" else "stopped", forward, back)
    apart = job.findings_back() or {}
    right = all_right(apart) and (not placed or all_right(placed))
    return end("right" if right else "silent", forward, back)


def _first_steps(job: TaughtJob, count: int) -> Ran:
    program = job.session.program
    program.put_cursor(program.first)
    return job.session.runner.forward(count)


def _checks(findings: Findings) -> dict[str, Check]:
    return {name: Check.of(finding) for name, finding in findings.items()}
