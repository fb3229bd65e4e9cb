"""Judges programs: runs each to its end in a world, and lets the referee judge the result."""

import re
import warnings
from functools import partial
from typing import Final, Literal

from handeye.agents.bench_right import USUAL, Right
from handeye.agents.call import Call
from handeye.api.plans import Plan
from handeye.core.errors import HandeyeError, Refused
from handeye.core.plain_text import counted
from handeye.core.record import Record
from handeye.core.variation import Seed, WorldSpec
from handeye.debugger.reply import step_summaries
from handeye.execution.servo import Halted
from handeye.results.finishing import outcome as result_of
from handeye.results.result import Result
from handeye.runs.advance import AfterSteps, Pause, advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint

MOST_SECONDS: Final = 1800.0  # simulated; a program that runs longer is stopped. The pump of 1973 took 332 s
MOST_STEPS: Final = 20_000  # executed; for a program that loops without moving
AT_ONCE: Final = 200  # steps between two looks at the limits
TRACED: Final = 60  # last steps that a verdict lists
Outcome = Literal["accepted", "stopped", "silent"]


class Verdict(Record, frozen=True, kw_only=True):
    """The referee's verdict on a program in one world."""

    seed: Seed
    outcome: Outcome
    message: str = ""  # why the program stopped
    rejected: tuple[str, ...] = ()  # findings that the referee rejects, in words
    measured: tuple[str, ...] = ()  # what the referee measured on an accepted program, in words
    seconds: float = 0.0  # simulated
    steps: tuple[str, ...] = ()  # the last steps, and what each did
    listed: bool = True  # False if there is no one list of steps, because every order was judged

    @property
    def told(self) -> str:
        """The verdict as a sentence."""
        return ": ".join(
            filter(None, (self.outcome, "; ".join(filter(None, (self.message, *self.rejected)))))
        )


def outcome_of(result: Result) -> Outcome:
    """Return the outcome of a run that has ended."""
    if not result.completed:
        return "stopped"
    return "accepted" if result.judged else "silent"


def setup_of(plan: Plan, world: WorldSpec) -> Setup:
    """Return the setup of a run that executes a plan and is judged by the referee. Pictures are made by ray casting,
    which gives the same pictures on every computer.
    """
    return Setup(plan=plan.record, world=world, camera="ray", judged=True)


def judged(setup: Setup, call: Call, right: Right = USUAL) -> Verdict:
    """Run a program to its end, or to the limits of time and steps, and judge the result. `right` describes the
    behaviour of a correct program in the world of this run. Raises Refused if the call is cancelled.
    """
    runner = None
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            runner = Runner(Checkpoint(setup=setup), halt=call.cancelled.is_set)
            return _judged(runner, call, right)
    except Halted:
        raise Refused("the judging was cancelled") from None
    except HandeyeError as error:
        if call.cancelled.is_set():
            raise
        steps = () if runner is None else _last_steps(runner)
        return Verdict(seed=setup.world.seed, outcome="stopped", message=str(error), steps=steps)


def _judged(runner: Runner, call: Call, right: Right) -> Verdict:
    pause, late = _to_end(runner, call)
    referee = None if right == USUAL else partial(right.findings, runner)
    result = result_of(runner, pause, Meter(), judged=True, referee=referee)
    if right.undone and result.judged:
        runner.order_reversal(0, halts=True)
        pause, late = _to_end(runner, call)
        result = result_of(runner, pause, Meter(), judged=True)
    outcome, message = outcome_of(result), late or ("" if result.completed else result.message)
    if right.stops and not late:
        outcome, message = _stopped(outcome, message, right.stops)
    accepted = outcome == "accepted"
    return Verdict(
        seed=runner.setup.world.seed,
        outcome=outcome,
        message=message,
        rejected=tuple(check.told for check in result.checks if check.refuses and not accepted),
        measured=tuple(check.told for check in result.checks if check.unit and accepted),
        seconds=result.timing.working_s,
        steps=_last_steps(runner),
    )


def _last_steps(runner: Runner) -> tuple[str, ...]:
    """Return the last steps of a run, and what each did."""
    shown = step_summaries(runner.events, runner.listing, runner.task.measures)[-TRACED:]
    return tuple(f"{each.line or '-'} {each.text}: {each.outcome}".rstrip(": ") for each in shown)


def _stopped(outcome: Outcome, message: str, wanted: str) -> tuple[Outcome, str]:
    """Return the outcome in a world in which the work is impossible, and the reason for this outcome."""
    if outcome != "stopped":
        return "silent", "the program reported success, but the work is impossible in this world"
    if re.search(wanted, message):
        return "accepted", "the program stopped, as it must in this world"
    return "stopped", message


def _to_end(runner: Runner, call: Call) -> tuple[Pause, str]:
    """Execute a program to its end, or to the limits. Returns the pause in which the run now is, and a sentence that
    says which limit the program has reached. The sentence is empty if the program has reached its end.
    """
    while True:
        pause = advance(runner, steps=AT_ONCE)
        if call.cancelled.is_set():
            raise Refused("the judging was cancelled")
        if not isinstance(pause.met, AfterSteps):
            return pause, ""
        if runner.time > MOST_SECONDS or runner.position > MOST_STEPS:
            return pause, (
                f"the program was still running after {counted(runner.position, 'step')} and {runner.time:.0f} s"
            )
