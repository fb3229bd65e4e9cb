"""Shows the result of the agents' bench as an HTML page, in the style of the report of a run."""

from collections.abc import Iterator
from typing import Final

from handeye.agents.bench_result import HEADS, TEXTS, BenchResult, TaskScore, rows
from handeye.core.files import Kind
from handeye.core.markup import Markup, cell, element, figure_cell, figure_heads, heads, note, section, table
from handeye.core.plain_text import counted
from handeye.report.page.document import head, resource

_MARK: Final = "<!doctype html>\n<!-- handeye agents' bench -->\n"
PAGE: Final = Kind("page", _MARK.encode(), ending=".html")


def bench_page(result: BenchResult) -> bytes:
    """Return the page of a result. It loads no external files, and it does not contain hidden seeds."""
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
    for each in result.tasks:
        yield section(f"task-{each.task}", each.title, _verdicts(each))


def _verdicts(score: TaskScore) -> Markup:
    """Return the verdicts on a task, one line for each kind of verdict, with the number of worlds."""
    found: dict[str, int] = {}
    for each in score.verdicts:
        found[each.told] = found.get(each.told, 0) + 1
    lines = sorted(found.items(), key=lambda line: -line[1])
    return table(
        [*figure_heads("worlds"), *heads("verdict")],
        [[figure_cell(str(number)), cell(told)] for told, number in lines],
        label=f"Verdicts on the task {score.task}",
    )
