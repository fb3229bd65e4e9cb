"""What a run came to, in one sentence."""

from typing import Final

from msgspec import UNSET

from handeye.report.facts.outcome import Outcome
from handeye.report.recorded import RecordedRun
from handeye.tasks import known
from handeye.tasks.interface import Words

_NEUTRAL: Final = Words(done="The referee found everything right.", product="the work")


def title(run: RecordedRun, outcome: Outcome) -> str:
    """What a run came to, in one sentence."""
    words, apart = _words(run), None if run.result is None else run.result.apart
    line = "" if outcome.step is None else f"line {outcome.step.place}"
    match outcome.kind:
        case "right":
            return words.apart if apart else words.done
        case "wrong" if apart is False:
            return "The arm has undone what it did, but not everything is back."
        case "wrong":
            return f"The program reported success, but {words.product} is not right."
        case "ended" if run.result is not None and run.result.apart is not UNSET:
            return "What the arm was to undo is undone."
        case "ended":
            return "The program came to its end."
        case "stopped":
            return f"Stopped in “{outcome.stage}”."
        case "panic":
            return f"The panic button was hit in “{outcome.stage}”."
        case "paused":
            return f"The run pauses before its end{f', after {line}' if line else ''}."
        case "broken off":
            return f"The trace breaks off{f' at {line}' if line else ''}."


def _words(run: RecordedRun) -> Words:
    task = known(run.trace.head.task)
    return _NEUTRAL if task is None else task.words
