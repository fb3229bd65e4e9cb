"""Shows the result of the agents' bench as an HTML page, in the style of the report of a run."""

from collections import Counter
from collections.abc import Iterator
from typing import Final

from handeye.agents.bench_result import HEADS, TEXTS, BenchResult, TaskScore, rows
from handeye.agents.judging import Outcome
from handeye.core.files import page_kind
from handeye.core.markup import Markup, cell, element, figure_cell, figure_heads, heads, note, section, table
from handeye.core.plain_text import counted
from handeye.report.page.document import head, resource

_MARK: Final = "<!DOCTYPE html>\n<!-- handeye agents' bench -->\n"
_CLASSES: Final[dict[Outcome, str]] = {"silent": "bad", "stopped": "doubtful", "accepted": "good"}
_ORDER: Final = (*_CLASSES,)
PAGE: Final = page_kind("page", _MARK)


def bench_page(result: BenchResult) -> bytes:
    """Return the page of a result. The page loads no external files, and does not contain hidden seeds."""
    passed = sum(each.passed for each in result.tasks)
    title = f"{passed} of {counted(len(result.tasks), 'task')} passed, mean score {result.score:.2f}"
    of = f"{result.entrant}, {result.seeds} worlds, feedback: {result.feedback}, protocol {result.protocol}"
    body = element(
        "body",
        element("header", element("div", element("h1", title), element("p", of, class_="name"))),
        element("main", *_sections(result)),
    )
    style = resource("page.css")
    return (_MARK + element("html", head(title, style, ()), body, lang="en") + "\n").encode()


def _sections(result: BenchResult) -> Iterator[Markup]:
    texts, figures = HEADS[:TEXTS], HEADS[TEXTS:]
    scores = table(
        [*heads(*texts), *figure_heads(*figures)],
        [[*map(cell, row[:TEXTS]), *map(figure_cell, row[TEXTS:])] for row in rows(result)],
        label="Scores of the tasks",
    )
    yield section(
        "scores",
        "Scores",
        scores,
        note(
            "A score is (accepted - 2 silent) / worlds, from -2 to 1. A silent failure is a program that reported "
            "success although its work was wrong."
        ),
    )
    verdicts = table(
        [*heads("task"), *figure_heads("worlds"), *heads("verdict")],
        [row for each in result.tasks for row in _verdicts(each)],
        label="Verdicts of the referee",
    )
    yield section("verdicts", "Verdicts", verdicts)


def _verdicts(score: TaskScore) -> Iterator[list[Markup]]:
    """Yield a row for each verdict on a task, with the number of worlds that have this verdict. Silent failures come
    first.
    """
    found = Counter((each.outcome, each.told) for each in score.verdicts)
    lines = sorted(found.items(), key=lambda line: (_ORDER.index(line[0][0]), -line[1]))
    for number, ((outcome, told), worlds) in enumerate(lines):
        word = element("span", outcome, class_=_CLASSES[outcome])
        title = score.title if number == 0 else None
        yield [cell(title), figure_cell(str(worlds)), cell(word, told.removeprefix(outcome))]
