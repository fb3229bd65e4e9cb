"""Judges a program: runs it to its end in several worlds, and lets the referee judge each result."""

import warnings
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import handeye.api.begin as api
from handeye.agents.call import Call
from handeye.agents.replies import outcome
from handeye.api.plans import Plan
from handeye.api.worlds import World
from handeye.core.errors import HandeyeError, Refused

MOST_SECONDS: Final = 1800.0  # simulated; a program that runs longer is stopped. The pump of 1973 took 300 s
MOST_STEPS: Final = 20_000  # executed; for a program that loops without moving
_AT_ONCE: Final = 200  # steps between two looks at the limits


@dataclass(frozen=True, slots=True, kw_only=True)
class Verdict:
    """The referee's verdict on a program in one world."""

    seed: int
    outcome: str  # `accepted`, `stopped` or `silent`
    message: str  # why the program stopped
    rejected: tuple[str, ...]  # findings that the referee rejects, in words
    seconds: float  # simulated


def judged(plan: Plan, worlds: Sequence[World], call: Call) -> list[Verdict]:
    """Run a plan in each world. Raises Refused if the call is cancelled."""
    found = []
    for number, world in enumerate(worlds):
        call.report(number, len(worlds), f"world {number + 1} of {len(worlds)}")
        found.append(_judged(plan, world, call))
    return found


def _judged(plan: Plan, world: World, call: Call) -> Verdict:
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            run = api.begin(plan, world=world, judge=True, halt=call.cancelled.is_set)
        except HandeyeError as error:
            if call.cancelled.is_set():
                raise
            return Verdict(seed=world.seed, outcome="stopped", message=str(error), rejected=(), seconds=0.0)
    message = ""
    while not run.ended and not message:
        state = run.step(_AT_ONCE)
        if call.cancelled.is_set():
            raise Refused("the submission was cancelled")
        if state.time > MOST_SECONDS or state.position > MOST_STEPS:
            message = f"the program was still running after {state.position} steps and {state.time:.0f} s"
    result = run.result
    return Verdict(
        seed=world.seed,
        outcome=outcome(result),
        message=message or result.message,
        rejected=tuple(check.told for check in result.checks if check.refuses),
        seconds=result.timing.working_s,
    )
