"""A run in a few figures, for the head of its page."""

from collections import Counter
from collections.abc import Iterator

from handeye.core.markup import Markup, element
from handeye.program import events as happened
from handeye.report.recorded import Recorded


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
