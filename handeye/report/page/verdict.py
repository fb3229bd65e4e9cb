"""Builds the top of the page: the outcome of the run and, if it failed, the reason, the line of the script, and
the sensor readings."""

from collections import Counter
from collections.abc import Iterator, Sequence
from typing import Final

from msgspec import UNSET

from handeye.core.markup import Markup, element, joined, note, to_moment
from handeye.core.plain_text import counted
from handeye.core.units import INCH
from handeye.program import events as happened
from handeye.program.diagnosis.cause_text import call_sentence
from handeye.program.events import (
    CameraBusy,
    CameraStarted,
    ErrorRaised,
    ErrorTested,
    OperatorCalled,
    PanicStopped,
    PictureTaken,
    StepStarted,
)
from handeye.report.facts.outcome import Outcome
from handeye.report.facts.told import CaptionedEvent, Senses, senses_at
from handeye.report.page.figures import clock, duration, exact_clock, millimetres
from handeye.report.page.referee import used
from handeye.report.page.source import excerpt
from handeye.report.photographs import Photograph, shown
from handeye.report.recorded import RecordedRun, told_faults
from handeye.results.result import Check
from handeye.tasks import known_any
from handeye.tasks.interface import Words
from handeye.trace.sentences import sentence

_NEUTRAL: Final = Words(done="The referee found everything right.", product="the work")


def title(run: RecordedRun, outcome: Outcome) -> str:
    """Return one sentence that says how the run ended."""
    task = known_any(run.trace.head.task)
    words = _NEUTRAL if task is None else task.words
    apart = None if run.result is None else run.result.apart
    line = "" if outcome.step is None else f"line {outcome.step.place}"
    match outcome.kind:
        case "right":
            return words.apart if apart else words.done
        case "wrong" if apart is False:
            return "The arm undid its work, but not everything is back in its place."
        case "wrong":
            return f"The program reported success, but {words.product} is not right."
        case "ended" if run.result is not None and run.result.apart is not UNSET:
            return "The undo is complete."
        case "ended":
            return "The program finished."
        case "stopped":
            return f"Stopped in “{outcome.stage}”."
        case "panic":
            return f"The panic button stopped the run in “{outcome.stage}”."
        case "paused":
            return f"The run is paused{f' after {line}' if line else ''}."
        case "broken off":
            return f"The recording breaks off{f' at {line}' if line else ''}."


def verdict(
    run: RecordedRun, outcome: Outcome, told: Sequence[CaptionedEvent], photograph: Photograph
) -> Markup:
    """Return the top of the page, with the outcome of the run."""
    head = run.trace.head
    arm = f" on the simulated {head.arm} arm" if head.arm else ""
    words = element(
        "div",
        element("p", f"Report of a run: {head.program}{arm}, {head.world}", class_="name"),
        element("h1", title(run, outcome)),
        *_said(run, outcome, told),
    )
    return element("header", words, shown(photograph), class_="failed" if outcome.failed else None)


def _said(run: RecordedRun, outcome: Outcome, told: Sequence[CaptionedEvent]) -> Iterator[Markup]:
    """Yield the sentences below the title."""
    yield from why(outcome)
    yield from _broken(run)
    if outcome.ended:
        yield element("p", *_course(run), class_="reason" if outcome.good else None)
        yield from _judged(run, outcome)
        yield from in_figures(run)
    else:
        yield from where(run, outcome, told)
    yield from _unseen(run)


def _unseen(run: RecordedRun) -> Iterator[Markup]:
    """Yield notes on parts of the run that the page cannot show."""
    if run.begins > 0:
        yield note(
            f"This run was resumed from a checkpoint, and its trace begins at {clock(run.begins)}. Events before "
            "that time come from the checkpoint; motions, pictures and forces before that time were not recorded."
        )
    if not run.whole:
        yield note(f"The trace is truncated: it ends at {clock(run.ends)}.")


def _course(run: RecordedRun) -> Iterator[str]:
    """Yield sentences on the progress and the duration of the run."""
    steps = counted(sum(isinstance(event, StepStarted) for event in run.trace.events), "step")
    stages = counted(len(run.trace.stages), "stage")
    yield f"The run executed {steps} in {stages} and took {duration(run.ends)} min of simulated time."
    then = run.period
    if then is not None:
        yield f" In {then.year} the work took {clock(then.times['manipulation'] + then.times['lens'])}."


def _judged(run: RecordedRun, outcome: Outcome) -> Iterator[Markup]:
    """If the work is right, yield the referee's verdict."""
    if run.result is None or not run.result.referee or not outcome.good:
        return
    shares = [(share, check) for check in run.result.referee.values() if (share := used(check)) is not None]
    told = f"The referee made {counted(len(run.result.referee), 'measurement')}"
    if shares:
        share, check = max(shares, key=lambda each: each[0])
        told += (
            f". The value closest to its limit is the {check.subject}, at {100 * share:.0f} % of the limit"
        )
    yield element("p", f"{told}.")
    for doubt in outcome.doubts:
        yield element("p", f"Caution: {doubt.told}.", class_="doubtful")


def _broken(run: RecordedRun) -> Iterator[Markup]:
    """Yield the faults injected in the run."""
    for name, meaning in told_faults(run):
        told = element("code", name)
        yield element("p", "Injected fault, unknown to the program: ", told, f". {meaning}", class_="broken")


def in_figures(run: RecordedRun) -> Iterator[Markup]:
    """Yield the statistics of a run as a list. Zeros are left out."""
    told = [(count, what) for count, what in _figures(run) if count]
    rows = (element("div", element("dd", str(count)), element("dt", what)) for count, what in told)
    if told:
        yield element("dl", *rows, class_="in-figures")


def _figures(run: RecordedRun) -> Iterator[tuple[int, str]]:
    kinds = Counter(type(event) for event in run.trace.events)
    yield kinds[happened.PictureTaken], "pictures taken"
    yield kinds[happened.GuardTripped], "motions stopped by a guard"
    yield kinds[happened.Adjusted], "goals moved by measurements"
    yield kinds[happened.SearchAdvanced], "extra places tried in searches"
    yield kinds[happened.ErrorTested], "tests for an error"
    if run.result is not None and run.result.referee:
        yield sum(check.ok for check in run.result.referee.values()), "referee measurements passed"


_UNTOLD: Final = (OperatorCalled, PanicStopped, ErrorTested, CameraBusy, CameraStarted, PictureTaken)
"""Kinds of events that the page does not list among the last sensor readings: events without sensor readings, and
events that only repeat the reason for the outcome.
"""
_SAID: Final = 4


def why(outcome: Outcome) -> Iterator[Markup]:
    """Yield sentences that say why the run failed."""
    yield from (element("p", reason, class_="reason") for reason in _reasons(outcome))


def _reasons(outcome: Outcome) -> Iterator[str]:
    if outcome.call is not None:
        yield _called(outcome.call)
    yield from map(_finding, outcome.wrong)
    if outcome.kind == "broken off":
        yield "The trace file is incomplete; this page shows the recorded part."
    if outcome.kind == "panic":
        yield "The user stopped the run. The drives are off and the brakes are set."


def _called(call: OperatorCalled) -> str:
    """Return a sentence that says why the program called the operator."""
    reason = call_sentence(call.message, call.error, call.cause)
    if call.message or not reason:
        return f"The program called the operator{f': “{reason}”' if reason else ''}."
    return f"{_capital(reason)}." if call.error is None else f"Error {call.error}: {reason}."


def _finding(check: Check) -> str:
    """Describe a failed finding in a sentence."""
    right = f"allowed: {check.relation} {check.limit:.3g} {check.unit}"
    return f"{_capital(check.subject)}: {check.value:.3g} {check.unit}; {right}."


def _capital(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}"


def where(run: RecordedRun, outcome: Outcome, told: Sequence[CaptionedEvent]) -> Iterator[Markup]:
    """Yield the progress of the run, the current line of the script, and the last sensor readings."""
    line = "" if outcome.step is None else f"Line {outcome.step.place}, "
    done = {stage.name for stage in run.trace.stages if stage.status == "done"}
    at = to_moment(outcome.time, exact_clock(outcome.time))
    stages = counted(len(run.program.stages), "stage")
    yield element("h2", joined([line, at, f" into the run, {len(done)} of {stages} done"]))
    if outcome.step is not None:
        yield excerpt(run.program, outcome.step)
    yield from _senses(run, outcome, told)


def _senses(run: RecordedRun, outcome: Outcome, told: Sequence[CaptionedEvent]) -> Iterator[Markup]:
    """Yield the last sensor readings."""
    rows = [(exact_clock(each.time), sentence(each.event)) for each in told if _tells(each, run, outcome)][
        -_SAID:
    ]
    now = senses_at(run, outcome.time)
    if now is not None:
        rows.append((exact_clock(outcome.time), _now(now)))
    if rows:
        yield element("h2", "Last sensor readings")
        items = (element("li", element("span", time, class_="time"), " ", said) for time, said in rows)
        yield element("ol", *items, class_="senses")


def _tells(each: CaptionedEvent, run: RecordedRun, outcome: Outcome) -> bool:
    """Return True if an event may explain the outcome. The event must have happened in the run's last stage, and must
    not be the reported reason itself.
    """
    begun = max((stage.begin for stage in run.trace.stages), default=0.0)
    call = outcome.call
    reason = isinstance(each.event, ErrorRaised) and call is not None and each.event.number == call.error
    return begun < each.time <= outcome.time and not (reason or isinstance(each.event, _UNTOLD))


def _now(senses: Senses) -> str:
    fingers = {(False, False): "neither finger touches", (True, True): "both fingers touch"}.get(
        senses.fingers, f"only finger {1 if senses.fingers[0] else 2} touches"
    )
    force = "" if senses.force is None else f", the hand presses with {senses.force:.1f} N"
    gap = f"{millimetres(senses.gap)} mm ({senses.gap / INCH:.2f} in)"
    return f"the fingers are {gap} open, {fingers}{force}"
