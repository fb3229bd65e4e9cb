"""Why a run failed, at which line, and what the senses said."""

from collections.abc import Iterator, Sequence
from typing import Final

from handeye.core.markup import Markup, element, joined, to_moment
from handeye.core.plain_text import counted
from handeye.core.units import INCH
from handeye.program.diagnosis.cause_text import call_sentence
from handeye.program.events import (
    CameraBusy,
    CameraStarted,
    ErrorRaised,
    ErrorTested,
    OperatorCalled,
    PanicStopped,
    PictureTaken,
)
from handeye.report.facts.outcome import Outcome
from handeye.report.facts.senses import Senses, senses_at
from handeye.report.facts.told import Told
from handeye.report.page.figures import exact_clock, millimetres
from handeye.report.page.source import excerpt
from handeye.report.recorded import Recorded
from handeye.results.result import Check
from handeye.trace.sentences import sentence

_UNTOLD: Final = (OperatorCalled, PanicStopped, ErrorTested, CameraBusy, CameraStarted, PictureTaken)
"""Events that are no word of the senses, or the reason itself."""
_SAID: Final = 4
"""Last sentences of the senses that are told."""


def why(outcome: Outcome) -> Iterator[Markup]:
    """Why the run failed."""
    yield from (element("p", reason, class_="reason") for reason in _reasons(outcome))


def _reasons(outcome: Outcome) -> Iterator[str]:
    if outcome.call is not None:
        yield _called(outcome.call)
    yield from map(_finding, outcome.wrong)
    if outcome.kind == "broken off":
        yield "The file ends in the middle; this page shows what there is of it."
    if outcome.kind == "panic":
        yield "A person stopped the run, not the program. The drives are off and the brakes are set."


def _called(call: OperatorCalled) -> str:
    """Why the program called the operator, as a sentence."""
    reason = call_sentence(call.message, call.error, call.cause)
    if call.message or not reason:
        return f"The program calls the operator{f': “{reason}”' if reason else ''}."
    return f"{_capital(reason)}." if call.error is None else f"Error {call.error}: {reason}."


def _finding(check: Check) -> str:
    """What the referee found wrong, as a sentence."""
    right = f"right is {check.relation} {check.limit:.3g} {check.unit}"
    return f"{_capital(check.subject)}: {check.value:.3g} {check.unit}; {right}."


def _capital(words: str) -> str:
    return f"{words[:1].upper()}{words[1:]}"


def where(run: Recorded, outcome: Outcome, told: Sequence[Told]) -> Iterator[Markup]:
    """How far the run came, the line at which it stands, and what the senses said last."""
    yield _reached(run, outcome)
    if outcome.step is not None:
        yield excerpt(run.program, outcome.step)
    yield from _senses(run, outcome, told)


def _senses(run: Recorded, outcome: Outcome, told: Sequence[Told]) -> Iterator[Markup]:
    """What the senses said last."""
    rows = [(exact_clock(each.time), sentence(each.event)) for each in told if _tells(each, run, outcome)][
        -_SAID:
    ]
    now = senses_at(run, outcome.time)
    if now is not None:
        rows.append((exact_clock(outcome.time), _now(now)))
    if rows:
        yield element("h2", "What the senses said last")
        items = (element("li", element("span", time, class_="time"), " ", said) for time, said in rows)
        yield element("ol", *items, class_="senses")


def _tells(each: Told, run: Recorded, outcome: Outcome) -> bool:
    """An event tells what led to the outcome: it is of the same stage, and not the reason itself once more."""
    begun = max((run.seconds(stage.begin) for stage in run.trace.stages), default=0.0)
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


def _reached(run: Recorded, outcome: Outcome) -> Markup:
    """How far the run came."""
    line = "" if outcome.step is None else f"Line {outcome.step.place}, "
    done = {stage.name for stage in run.trace.stages if stage.status == "done"}
    at = to_moment(outcome.time, exact_clock(outcome.time))
    stages = counted(len(run.program.stages), "stage")
    return element("h2", joined([line, at, f" after it began, {len(done)} of {stages} done"]))
