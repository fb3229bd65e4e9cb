"""The page of a run whose system follows no plan of motions: what happened line by line, and what was found."""

from collections.abc import Iterator

from handeye.core.markup import Markup, element, section
from handeye.core.plain_text import printable
from handeye.report.facts.outcome import outcome
from handeye.report.page.channels import channels_section
from handeye.report.page.document import MARK, head, resource
from handeye.report.page.record import facts
from handeye.report.page.referee import findings_table
from handeye.report.page.timing import timing_section
from handeye.report.page.title import title
from handeye.report.recorded import RecordedRun
from handeye.trace.account import account


def account_page(run: RecordedRun) -> bytes:
    """The report of a run of any system; the same for the same trace and result."""
    came = outcome(run)
    said = title(run, came)
    top = element("header", element("h1", said), class_="failed" if came.failed else None)
    body = element("body", top, element("main", *_sections(run)))
    name = printable(f"{run.trace.head.program}: {said}")
    page = element("html", head(name, resource("page.css"), []), body, lang="en")
    return f"{MARK}{page}\n".encode()


def _sections(run: RecordedRun) -> Iterator[Markup]:
    yield section("account", "What happened", element("pre", "\n".join(account(run.trace.events))))
    yield timing_section(run)
    yield channels_section(run.trace)
    if run.result is not None and run.result.checks:
        yield section("referee", "What the referee measured", findings_table(run.result.checks))
    yield section("record", "World and versions", facts(run))
