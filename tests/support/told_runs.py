"""Made-up runs of a short script, which consist only of events, step by step."""

from collections.abc import Callable, Sequence
from functools import partial

from recordings import started
from short_runs import GRASP, plan_of

from handeye.planfile.store import encode
from handeye.program.events import AnyEvent, Saved, StepFinished, StepStarted
from handeye.report.recorded import RecordedRun
from handeye.trace.trace import Trace

Happening = Callable[..., AnyEvent]
"""An event without its time."""


def happens(kind: Callable[..., AnyEvent], **fields: object) -> Happening:
    """An event in a step."""
    return partial(kind, **fields)


def told(*steps: tuple[str, Sequence[Happening]], script: str = GRASP) -> RecordedRun:
    """Return a run of a script in which some steps were executed. Each step is given by its first words."""
    plan = plan_of(script)
    events: list[AnyEvent] = [started()]
    for number, (words, inside) in enumerate(steps):
        time = 1.0 + number
        step = next(n for n, step in enumerate(plan.program.steps) if step.text.startswith(words))
        line, text = plan.program.steps[step].line, plan.program.steps[step].text
        events.append(StepStarted(time=time, step=step, line=line, text=text))
        events += [each(time=time + 0.5) for each in inside]
        events.append(StepFinished(time=time + 0.9, step=step, hand=None, planned=None, gap=None))
    trace = Trace(
        name="told.mcap", version=4, head=started(), plan=encode(plan).encode(), events=tuple(events), counts={},
        messages=(),
    )  # fmt: skip
    return RecordedRun(trace=trace)


def saved(x: float) -> tuple[str, Sequence[Happening]]:
    """The step of the script that saves, with what it saves (m)."""
    return "SAVE", [happens(Saved, name="C1", difference=(x, 0.0, 0.0))]
