"""Executes a taught job, reverses it, and lets the referee judge the work and the reversal."""

from collections.abc import Callable, Mapping
from typing import Final, Literal

from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.core.variation import Seed, WorldSpec
from handeye.results.finishing import outcome
from handeye.results.result import Check, Result
from handeye.runs.advance import Pause, advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.systems.trig import ENTRY
from handeye.systems.trig.jobs.benches import JOBS, BlockPose, JobName, TaughtPlan, job_script
from handeye.systems.trig.language.program_commands import told_run
from handeye.systems.trig.language.reports import RunLeg
from handeye.systems.trig.language.running import RunResult
from handeye.systems.trig.run.running_job import RunningJob, plan_of

Outcome = Literal["right", "stopped", "silent", "halted"]
"""The outcome of a job. `right`: the job finished, and the referee agrees. `stopped`: the program or the arm stopped
early. `silent`: the job finished, but the referee disagrees. `halted`: the user stopped the job.
"""

When = Literal["taught", "run", "undone"]


class JobReport(Record, frozen=True, kw_only=True):
    """The result of a job, including its reversal."""

    job: JobName
    seed: Seed  # seed of the world
    world: str = ""  # specification of the world in words, if it is more than a seed
    blocks: int | None = None
    interrupted_after: int | None = None  # number of steps after which the job was reversed
    outcome: Outcome
    forward: RunLeg | None = None
    back: RunLeg | None = None
    checks: Mapping[str, Check] = {}  # the referee's findings at the end of the program
    checks_back: Mapping[str, Check] = {}  # the referee's findings after the reversal
    goals: tuple[
        tuple[float, float], ...
    ] = ()  # wanted places of the blocks, in the order in which the arm takes them, mm
    lying: Mapping[When, tuple[BlockPose, ...]] = {}  # true poses, in the order of `goals`
    told: tuple[str, ...] = ()  # a sentence on how each leg ended
    ended_s: float | None = None  # time at which the program ended, on the arm's clock
    arm_s: float = 0.0  # time on the arm's clock, including the teaching

    @property
    def wrong(self) -> tuple[Check, ...]:
        return tuple(check for check in (*self.checks.values(), *self.checks_back.values()) if check.refuses)


def setup_of_job(name: JobName, world: WorldSpec, blocks: int | None) -> Checkpoint:
    """Return a new run of a job. `blocks` is the number of blocks in the palletiser's stack."""
    plan = TaughtPlan(job=name, script=job_script(name, blocks or 0))
    setup = Setup(system=ENTRY.name, plan=plan, world=world, camera="auto", judged=True)
    return Checkpoint(setup=setup)


def program_plan(task: str, name: str, text: str, variant: str = "") -> TaughtPlan:
    """Return the plan of a run in which the user's script `text` teaches the job `task`. TRIG's jobs have no
    variants.
    """
    return TaughtPlan(job=next(job for job in JOBS if job == task), script=text)


def job_of(runner: Runner) -> RunningJob:
    assert isinstance(runner.system, RunningJob)
    return runner.system


def carry_out(
    runner: Runner,
    *,
    after: int | None = None,
    go: Callable[[int | None], Pause] | None = None,
    tell: Callable[[str], None] = lambda _: None,
) -> Pause:
    """Execute a job from its present state to the end of its program. If `after` is given, execute only this number of
    steps. Then reverse the job, if it can be reversed.

    `go` executes a number of steps, or all steps if the number is None. The default `go` works without an operator.
    `tell` is called twice: with a sentence on how the program ended, and with a sentence on how the reversal ended.
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
    """Execute a job, without saving it in a folder, and return its result. `after` has the same meaning as for
    `carry_out`.
    """
    pause = carry_out(runner, after=after)
    return account(runner, pause, outcome(runner, pause, Meter(), judged=True), after=after)


def _turns(runner: Runner, pause: Pause, after: int | None) -> bool:
    """Return True if the run has reached the point at which the reversal is due, and if the job can be reversed."""
    there = pause.kind == "end" or (after is not None and pause.kind == "break")
    system = job_of(runner)
    return there and system.job.undoable and not runner.undone and len(system.executed) > 0


def ends_job(runner: Runner, result: Result) -> bool:
    """Return True if a run is a job that has ended. If the program of the job was completed, the referee must also
    have judged the job. Return False if the run was reversed because a user ordered the reversal.
    """
    system = runner.system
    if not isinstance(system, RunningJob) or result.paused or (runner.undone and system.state.turn is None):
        return False
    return not result.completed or result.judged is not None


def account(runner: Runner, pause: Pause, result: Result, *, after: int | None = None) -> JobReport:
    """Return the result of a job that has ended. `after` is the number of steps that the job did before the reversal,
    or None if the user set no number.
    """
    system, world = job_of(runner), runner.setup.world
    job, plan, turn = system.job, plan_of(runner.setup), system.state.turn
    way, told = _way(runner, pause)
    lying: dict[When, tuple[BlockPose, ...]] = {"taught": job.lying("taught"), "run": job.lying("now")}
    forward, back, built = way, None, result.referee
    sentences: tuple[str, ...] = (told,)
    if turn is not None:
        ran = RunResult(steps=turn.steps, end="none" if turn.ended else "count")
        forward, back, sentences = _record(ran), way, (told_run(ran), told)
        lying |= {"run": job.lying("turned"), "undone": job.lying("now")}
        built = result.built or {}
    return JobReport(
        job=plan.job,
        seed=world.seed,
        world="" if world == WorldSpec(seed=world.seed) else str(world),
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


def _way(runner: Runner, pause: Pause) -> tuple[RunLeg | None, str]:
    """Return a record of the part of the job that has just ended, and a sentence on how this part ended. The part is
    either the program or its reversal. The record is None if the arm refused a step.
    """
    system, state = job_of(runner), job_of(runner).state
    if pause.kind in ("operator", "trouble") and state.obstacle is None:
        return None, pause.message
    undoing, done = state.turn is not None, len(system.executed)
    steps = done if state.turn is None else state.turn.steps - done
    ran = RunResult(steps=steps, end=_end(pause, undoing=undoing), obstacle=state.obstacle)
    if ran.end == "halted":  # TRIG has no command that resumes a job
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
