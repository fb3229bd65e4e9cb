"""The referee is called to a run that is over."""

from handeye.judge.finding import Findings
from handeye.runs.advance import Pause
from handeye.runs.runner import Runner


def findings(runner: Runner, pause: Pause) -> Findings:
    """Ask the referee of the task; nothing of a program that did not come to its end."""
    return runner.task.judge(runner.cell.truth) if pause.kind == "end" else {}
