"""The head of the page: what the run came to, and, if it failed, why, at which line, and what the senses said."""

from collections.abc import Iterator, Sequence
from typing import Final

from handeye.events import CameraBusy, ErrorRaised, ErrorTested, OperatorCalled, PanicStopped, StepStarted
from handeye.markup import Markup
from handeye.plain_text import counted
from handeye.program.cause_text import call_sentence
from handeye.report.result import Check
from handeye.see.facts.faults import told_faults
from handeye.see.facts.outcome import Outcome
from handeye.see.facts.senses import Senses, senses_at
from handeye.see.facts.told import Told
from handeye.see.page.elements import data_address, element, joined, to_moment
from handeye.see.page.figures import clock, duration, exact_clock, millimetres
from handeye.see.page.in_figures import in_figures
from handeye.see.page.referee import used
from handeye.see.page.source import excerpt
from handeye.see.photographs import Photograph
from handeye.see.recorded import Recorded
from handeye.tasks import known
from handeye.tasks.interface import Words
from handeye.trace.sentences import sentence

_NEUTRAL: Final = Words(done="The referee found everything right.", product="the work")
_UNTOLD: Final = (OperatorCalled, PanicStopped, ErrorTested, CameraBusy)
"""Events that are no word of the senses, or the reason itself."""
_SAID: Final = 4
"""Last sentences of the senses that are told of a run that failed."""


def verdict(run: Recorded, outcome: Outcome, told: Sequence[Told], photograph: Photograph) -> Markup:
    """The head of the page."""
    head = run.trace.head
    name = element("p", f"{head.program}, {head.world}", class_="name")
    words = element(
        "div", name, element("h1", title(run, outcome)), *_said(run, outcome, told), class_="said"
    )
    return element(
        "header", words, _picture(photograph, outcome), class_="good" if outcome.good else "failed"
    )


def title(run: Recorded, outcome: Outcome) -> str:
    """What a run came to, in one sentence."""
    words = _words(run)
    where = "" if outcome.step is None else f" at line {outcome.step.place}"
    match outcome.kind:
        case "right":
            return words.done
        case "wrong":
            return f"The program reported success, but {words.product} is not right."
        case "ended":
            return "The program came to its end."
        case "stopped":
            return f"Stopped{where}, in “{outcome.stage}”."
        case "panic":
            return f"The panic button was hit{where}, in “{outcome.stage}”."
        case "paused":
            return f"The run pauses before its end{where and ' after' + where.removeprefix(' at')}."
        case "broken off":
            return f"The trace breaks off{where}."


def _words(run: Recorded) -> Words:
    task = known(run.trace.head.task)
    return _NEUTRAL if task is None else task.words


def _said(run: Recorded, outcome: Outcome, told: Sequence[Told]) -> Iterator[Markup]:
    """What there is to say below the title."""
    if outcome.good:
        yield element("p", *_course(run), class_="reason")
        yield from _judged(run, outcome)
        yield in_figures(run)
        return
    yield from _why(outcome)
    if outcome.kind == "wrong":
        yield element("p", *_course(run))
        yield in_figures(run)
        return
    if outcome.step is not None:
        yield excerpt(run.program, outcome.step)
    yield from _senses(run, outcome, told)
    yield from _reached(run, outcome)


def _course(run: Recorded) -> Iterator[str]:
    """How far the run came and how long it took."""
    steps = counted(sum(isinstance(event, StepStarted) for event in run.trace.events), "step")
    stages = counted(len(run.trace.stages), "stage")
    yield f"{steps} in {stages}, {duration(run.ends)} min on the cell’s clock."
    task = known(run.trace.head.task)
    then = None if task is None else task.period
    if then is not None and then.program == run.trace.head.program:
        yield f" In {then.year} it took {clock(then.times['manipulation'] + then.times['lens'])}."


def _judged(run: Recorded, outcome: Outcome) -> Iterator[Markup]:
    """What the referee said of work that is right."""
    if run.result is None or not run.result.referee:
        return
    shares = [(share, check) for check in run.result.referee.values() if (share := used(check)) is not None]
    told = f"The referee made {counted(len(run.result.referee), 'measurement')}"
    if shares:
        share, check = max(shares, key=lambda each: each[0])
        told += f"; nearest to its limit is the {check.subject}, which uses {100 * share:.0f} % of it"
    yield element("p", f"{told}.")
    for doubt in outcome.doubts:
        yield element("p", f"Caution: {doubt.told}.", class_="doubtful")


def _why(outcome: Outcome) -> Iterator[Markup]:
    """Why the run failed."""
    if outcome.call is not None:
        call = outcome.call
        reason = call_sentence(call.message, call.error, call.cause)
        number = "" if call.error is None else f" (error {call.error})"
        yield element("p", f"{reason[:1].upper()}{reason[1:]}{number}.", class_="reason")
    for check in outcome.wrong:
        yield element("p", _finding(check), class_="reason")
    if outcome.kind == "broken off":
        yield element(
            "p", "The file ends in the middle; this page shows what there is of it.", class_="reason"
        )
    if outcome.kind == "panic":
        yield element("p", "The drives are off and the brakes are set.", class_="reason")


def _finding(check: Check) -> str:
    """What the referee found wrong, as a sentence."""
    subject = f"{check.subject[:1].upper()}{check.subject[1:]}"
    return f"{subject}: {check.value:.3g} {check.unit}; right is {check.relation} {check.limit:.3g} {check.unit}."


def _senses(run: Recorded, outcome: Outcome, told: Sequence[Told]) -> Iterator[Markup]:
    """What the senses said last."""
    rows = [(exact_clock(each.time), sentence(each.event)) for each in told if _tells(each, run, outcome)][
        -_SAID:
    ]
    now = senses_at(run, outcome.time)
    if now is not None:
        rows.append((exact_clock(outcome.time), _now(now)))
    if rows:
        yield element("h2", "What the senses said")
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
    return f"the fingers are {millimetres(senses.gap)} mm open, {fingers}{force}"


def _reached(run: Recorded, outcome: Outcome) -> Iterator[Markup]:
    """How far the run came, and what of its world was broken on purpose."""
    names = run.program.stages
    done = sum(stage.status == "done" for stage in run.trace.stages)
    at = to_moment(outcome.time, exact_clock(outcome.time))
    yield element("p", joined([f"{done} of {counted(len(names), 'stage')} done, at ", at, "."]))
    for name, meaning in told_faults(run):
        yield element(
            "p", "Broken on purpose in this world: ", element("code", name), f". {meaning}", class_="broken"
        )


def _picture(photograph: Photograph, outcome: Outcome) -> Markup:
    if photograph.webp is None:
        return element("p", photograph.missing, class_="missing")
    image = element(
        "img",
        src=data_address("image/webp", photograph.webp),
        alt=photograph.shows,
        width=photograph.width,
        height=photograph.height,
    )
    return element("figure", image, element("figcaption", photograph.shows))
