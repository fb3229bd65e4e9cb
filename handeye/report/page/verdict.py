"""The head of the page: verdict and figures and, if it failed, why, at which line, and what the senses said."""

from collections import Counter
from collections.abc import Iterator, Sequence

from handeye.core.markup import Markup, element, note
from handeye.core.plain_text import counted
from handeye.program import events as happened
from handeye.program.events import StepStarted
from handeye.report.facts.faults import told_faults
from handeye.report.facts.outcome import Outcome
from handeye.report.facts.told import Told
from handeye.report.page.failure import where, why
from handeye.report.page.figures import clock, duration
from handeye.report.page.photograph import shown
from handeye.report.page.referee import used
from handeye.report.page.title import title
from handeye.report.photographs import Photograph
from handeye.report.recorded import Recorded
from handeye.tasks import known


def in_figures(run: Recorded) -> Iterator[Markup]:
    """The figures as a list; of what there was none, nothing is said."""
    told = [(count, what) for count, what in _figures(run) if count]
    rows = (element("div", element("dd", str(count)), element("dt", what)) for count, what in told)
    if told:
        yield element("dl", *rows, class_="in-figures")


def _figures(run: Recorded) -> Iterator[tuple[int, str]]:
    kinds = Counter(type(event) for event in run.trace.events)
    yield kinds[happened.PictureTaken], "pictures taken"
    yield kinds[happened.GuardTripped], "motions ended by what the hand felt"
    yield kinds[happened.Adjusted], "goals moved by what was sensed"
    yield kinds[happened.SearchAdvanced], "further places tried in searches"
    yield kinds[happened.ErrorTested], "times the program tested for an error"
    if run.result is not None and run.result.referee:
        yield sum(check.ok for check in run.result.referee.values()), "findings of the referee right"


def verdict(run: Recorded, outcome: Outcome, told: Sequence[Told], photograph: Photograph) -> Markup:
    """The head of the page."""
    words = element("div", _name(run), element("h1", title(run, outcome)), *_said(run, outcome, told))
    return element("header", words, shown(photograph), class_="failed" if outcome.failed else None)


def _name(run: Recorded) -> Markup:
    """What the page is a report of."""
    head = run.trace.head
    arm = f"the simulated {head.arm} arm carries out " if head.arm else ""
    return element("p", f"Report of a run: {arm}{head.program} in the world of {head.world}", class_="name")


def _said(run: Recorded, outcome: Outcome, told: Sequence[Told]) -> Iterator[Markup]:
    """What there is to say below the title."""
    yield from why(outcome)
    yield from _broken(run)
    if outcome.ended:
        yield element("p", *_course(run), class_="reason" if outcome.good else None)
        yield from _judged(run, outcome)
        yield from in_figures(run)
    else:
        yield from where(run, outcome, told)
    yield from _unseen(run)


def _unseen(run: Recorded) -> Iterator[Markup]:
    """What of the run the page cannot show."""
    if run.begins > 0:
        yield note(
            f"This run was taken up from a checkpoint: its trace begins at {clock(run.begins)}. What happened before "
            "is told by the checkpoint; how the arm moved, and what was seen and felt, was not recorded."
        )
    if not run.whole:
        yield note(f"The trace was cut short: it ends at {clock(run.ends)}.")


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
    if run.result is None or not run.result.referee or not outcome.good:
        return
    shares = [(share, check) for check in run.result.referee.values() if (share := used(check)) is not None]
    told = f"The referee made {counted(len(run.result.referee), 'measurement')}"
    if shares:
        share, check = max(shares, key=lambda each: each[0])
        told += f"; nearest to its limit is the {check.subject}, which uses {100 * share:.0f} % of it"
    yield element("p", f"{told}.")
    for doubt in outcome.doubts:
        yield element("p", f"Caution: {doubt.told}.", class_="doubtful")


def _broken(run: Recorded) -> Iterator[Markup]:
    """What of its world was broken on purpose."""
    for name, meaning in told_faults(run):
        told = element("code", name)
        yield element(
            "p", "Broken on purpose, unknown to the program: ", told, f". {meaning}", class_="broken"
        )
