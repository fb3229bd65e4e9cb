"""Texts planned and carried out in a workplace, and what is answered."""

from collections.abc import Sequence

from msgspec import UNSET

from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source
from handeye.debugger.step_summary import step_summaries
from handeye.planning.scripts import PlannedScript
from handeye.results.pauses import pause_sentence
from handeye.runs.advance import Pause
from handeye.teaching.answers import NOTHING, Answer, LineResult
from handeye.teaching.workplace import Workplace


def carry_out(workplace: Workplace, source: Source, *, alone: bool = False) -> Answer:
    """Plan a text, and carry the plan out if there is one.

    Args:
        alone: the text is only a part of what is done, and need not make sense by itself.

    Raises:
        InvalidInput: it looks, and the camera was not set up.
    """
    checked = workplace.plan(source, alone=alone)
    said = NOTHING if checked.plan is None else done(workplace, workplace.carry_out(checked.plan))
    return about(workplace, checked, checked.diagnostics, said)


def done(workplace: Workplace, pause: Pause, happened: int = 0) -> LineResult:
    """Tell what was done after the first `happened` events of the plan under way."""
    runner = workplace.runner
    told = step_summaries(runner.events[happened:], runner.listing, runner.task.measures)
    did = tuple(step for step in told if step.line is not None)
    return LineResult(did=did, pause=pause, said=UNSET if did else pause_sentence(pause))


def about(
    workplace: Workplace, checked: PlannedScript, found: Sequence[Diagnostic], said: LineResult = NOTHING
) -> Answer:
    """An answer with what was found in a text."""
    return Answer(time=workplace.elapsed, said=said, source=checked.source, diagnostics=tuple(found))


def answer(workplace: Workplace, said: LineResult = NOTHING) -> Answer:
    """An answer that says so much."""
    return Answer(time=workplace.elapsed, said=said)
