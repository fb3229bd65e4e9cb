"""What each answer to a call of the operator does where a run stands, in words."""

from collections.abc import Mapping

from handeye.program.events import Choice
from handeye.runs.operator import undoing
from handeye.runs.runner import Runner
from handeye.systems.stanford.executor_run import ProgramSystem


def choices(runner: Runner) -> Mapping[Choice, str]:
    """The answers that can be given to the call of the operator that a run stands at, and what each does."""
    if isinstance(runner.system, ProgramSystem):
        return _of_stages(runner)
    if undoing(runner):
        return {"proceed": "proceed: have the step undone again", "retry": "retry: the same"}
    return {
        "proceed": "proceed: have the step done again",
        "retry": "retry: the same",
        "skip": "skip: end the program here",
    }


def _of_stages(runner: Runner) -> Mapping[Choice, str]:
    """Those to a program in stages."""
    steps, onward = runner.listing.steps, runner.onward
    first = next(step.place for step in steps if step.stage == runner.stage)
    where = "to the end of the program" if onward is None else f"continue at line {steps[onward].place}"
    return {
        "proceed": "proceed: go on undoing" if undoing(runner) else f"proceed: {where}",
        "retry": f"retry the stage from line {first}, with the world as it is now",
        "skip": "skip the rest of the stage",
    }
