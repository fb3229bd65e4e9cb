"""A job that is taught: carried out, undone, and judged after both."""

from collections.abc import Callable, Mapping
from typing import Final, Literal

from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.results.outcome import outcome
from handeye.results.result import Check, Result
from handeye.runs.advance import Pause, advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.systems.trig.jobs.benches import JobName, Lying, TaughtPlan, job_script
from handeye.systems.trig.language.cursor_commands import told_run
from handeye.systems.trig.language.reports import RunLeg
from handeye.systems.trig.language.running import RunResult
from handeye.systems.trig.run.system import TAUGHT, RunningJob, plan_of

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
    forward: RunLeg | None = None
    back: RunLeg | None = None
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
    setup = Setup(system=TAUGHT.name, plan=plan, world=WorldSpec(seed=seed), camera="auto", judged=True)
    return Checkpoint(setup=setup)


def job_of(runner: Runner) -> RunningJob:
    """The system that carries out a job."""
    assert isinstance(runner.system, RunningJob)
    return runner.system


def carry_out(
    runner: Runner,
    *,
    after: int | None = None,
    go: Callable[[int | None], Pause] | None = None,
    tell: Callable[[str], None] = lambda _: None,
) -> Pause:
    """Carry out a job from where it stands: to the end of its program, and back, if that can be.

    Args:
        after: steps after which it is undone; None: it comes to its end.
        go: has the run do so many steps, or all that are left; by default nobody answers for the operator.
        tell: is told how either way has ended.
    """
    go = go or (lambda steps: advance(runner, steps=steps))
    if job_of(runner).state.turn is None:
        pause = go(after)
        tell(_way(runner, pause)[1])
        if not _turns(runner, pause, after):
            return pause
        runner.order_reversal(0, halts=True, asked_by="job")
    pause = go(None)
    tell(_way(runner, pause)[1])
    return pause


def carried_out(runner: Runner, *, after: int | None = None) -> JobReport:
    """What comes of a job that is carried out and leaves no folder; `after`: as for `carry_out`."""
    pause = carry_out(runner, after=after)
    return account(runner, pause, outcome(runner, pause, Meter(), judged=True), after=after)


def _turns(runner: Runner, pause: Pause, after: int | None) -> bool:
    """The run has come as far as it was to, and is undone from there."""
    there = pause.kind == "end" or (after is not None and pause.kind == "break")
    system = job_of(runner)
    return there and system.job.undoable and not runner.undone and len(system.executed) > 0


def ends_job(runner: Runner, result: Result) -> bool:
    """A run is a job that is over and was judged; undone because somebody said so, it is none."""
    system = runner.system
    if not isinstance(system, RunningJob) or result.paused or (runner.undone and system.state.turn is None):
        return False
    return not result.completed or result.judged is not None


def account(runner: Runner, pause: Pause, result: Result, *, after: int | None = None) -> JobReport:
    """What came of a job that pauses and does not go on; the referee's word is that of its result.

    Args:
        after: steps after which it was to be undone.
    """
    system = job_of(runner)
    job, plan, turn = system.job, plan_of(runner.setup), system.state.turn
    way, told = _way(runner, pause)
    lying: dict[When, tuple[Lying, ...]] = {"taught": job.lying("taught"), "run": job.lying("now")}
    forward, back, built = way, None, result.referee
    sentences: tuple[str, ...] = (told,)
    if turn is not None:
        ran = RunResult(steps=turn.steps, end="none" if turn.ended else "count")
        forward, back, sentences = _record(ran), way, (told_run(ran), told)
        lying |= {"run": job.lying("turned"), "undone": job.lying("now")}
        built = result.built or {}
    return JobReport(
        job=plan.job,
        seed=runner.setup.world.seed,
        blocks=job.stack,
        interrupted_after=after,
        outcome="halted" if pause.kind == "panic" else _OUTCOMES[result.exit_code],
        forward=forward,
        back=back,
        checks=built,
        checks_back={} if turn is None else result.referee,
        goals=job.goals,
        lying=lying,
        told=sentences,
        ended_s=round(runner.time if turn is None else turn.time, 6),
        arm_s=round(runner.time, 6),
    )


_OUTCOMES: Final[Mapping[int, Outcome]] = {0: "right", 1: "stopped", 3: "silent"}
"""By the exit codes of results."""


def _way(runner: Runner, pause: Pause) -> tuple[RunLeg | None, str]:
    """How far the way has come that a run is on, and that in words; None: the arm refused a step."""
    system, state = job_of(runner), job_of(runner).state
    if pause.kind in ("operator", "trouble") and state.obstacle is None:
        return None, pause.message
    undoing, done = state.turn is not None, len(system.executed)
    steps = done if state.turn is None else state.turn.steps - done
    ran = RunResult(steps=steps, end=_end(pause, undoing=undoing), obstacle=state.obstacle)
    if ran.end == "halted":  # nobody goes on with it by a command of TRIG
        return _record(ran), f"{counted(steps, 'step')} {'undone' if undoing else 'done'}; interrupted"
    return _record(ran), told_run(ran, back=undoing)


def _record(ran: RunResult) -> RunLeg:
    return RunLeg(steps=ran.steps, end=ran.end, obstacle=ran.obstacle)


def _end(pause: Pause, *, undoing: bool) -> Literal["count", "none", "halted", "beginning", "stopped"]:
    match pause.kind:
        case "panic":
            return "halted"
        case "operator" | "trouble":
            return "stopped"
        case "end":
            return "beginning" if undoing else "none"
    return "count"
