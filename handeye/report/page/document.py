"""Builds the whole page, with or without a plan. The page is one file that loads no other files and runs only
its own scripts."""

from base64 import b64encode
from collections.abc import Iterator, Sequence
from hashlib import sha256
from pathlib import Path
from typing import Final

from handeye.core.files import page_kind
from handeye.core.markup import Markup, PagePart, contents, element, lines, section
from handeye.core.plain_text import printable
from handeye.report import player
from handeye.report.animation import Animation
from handeye.report.facts.felt import guarded_motions, lost_trips
from handeye.report.facts.outcome import outcome
from handeye.report.facts.planned import corrections, ends, searches
from handeye.report.facts.seen import lost_pictures, seen_pictures
from handeye.report.facts.told import told
from handeye.report.page.felt import How, channels_section, felt_section
from handeye.report.page.moments import moments
from handeye.report.page.overlay import overlay
from handeye.report.page.planned import planned_section
from handeye.report.page.record import facts, record_section, world_quantities
from handeye.report.page.referee import findings_table, referee_section
from handeye.report.page.seen import seen_section
from handeye.report.page.timing import timing_section
from handeye.report.page.verdict import title, verdict
from handeye.report.page.view import view_section, widths
from handeye.report.photographs import Album
from handeye.report.recorded import RecordedRun
from handeye.trace.account import account

MARK: Final = "<!DOCTYPE html>\n<!-- handeye report -->\n"
REPORT: Final = page_kind("report of handeye", MARK)


def report_page(run: RecordedRun, photographs: Album, animated: Animation | None) -> bytes:
    """Return the report of a run. On the same computer, equal traces and results give equal pages. Raises
    InvalidInput if the trace is invalid.

    Args:
        animated: the 3D animation; if None, the page shows only photographs.
    """
    came, heard = outcome(run), told(run)
    sections = tuple(_sections(run, photographs, failed=came.failed))
    scripts = [*([] if animated is None else [player.script()]), resource("page.js")]
    body = element(
        "body",
        verdict(run, came, heard, photographs.leading),
        contents(sections),
        element("main", *sections),
        moments(run, came, heard),
        *([] if animated is None else _animated(run, animated)),
        *(element("script", Markup(script)) for script in scripts),
    )
    name = printable(f"{run.trace.head.program}: {title(run, came)}")
    page = element("html", head(name, resource("page.css") + widths(run), scripts), body, lang="en")
    return (MARK + page + "\n").encode()


def _animated(run: RecordedRun, animated: Animation) -> Iterator[Markup]:
    yield packed("scene", animated.scene)
    yield packed("tracks", animated.tracks)
    yield overlay(run)


def _sections(run: RecordedRun, photographs: Album, *, failed: bool) -> Iterator[Markup]:
    felt, stages = guarded_motions(run), run.trace.stages
    yield view_section(run, photographs.stages)
    yield timing_section(run)
    yield seen_section(seen_pictures(run), lost=lost_pictures(run))
    yield felt_section(
        felt,
        how=How.THINNED if run.trace.thinned else How.RECORDED,
        lost=lost_trips(run, felt),
        failed=failed,
    )
    yield channels_section(run.trace)
    yield planned_section(ends(run), corrections(run), searches(run), stages)
    yield referee_section(run)
    yield record_section(run)


def head(name: str, style: str, scripts: Sequence[str], *also: str) -> Markup:
    """Return the head of a page, with a content security policy that permits only the page's own style and
    scripts.

    Args:
        also: further directives for the policy.
    """
    own = f"script-src {' '.join(map(_digest, scripts))}", f"style-src {_digest(style)}"
    policy = "; ".join(("default-src 'none'", *own, "img-src data: blob:", *also))
    return element(
        "head",
        element("meta", charset="utf-8"),
        element("meta", http_equiv="Content-Security-Policy", content=policy),
        element("meta", name="viewport", content="width=device-width, initial-scale=1"),
        element("title", name),
        element("style", Markup(style)),
    )


def packed(name: str, data: bytes) -> Markup:
    """Embed compressed data in the page, so that a script of the page can decompress them."""
    return element("script", Markup(b64encode(data).decode()), id=name, type="application/octet-stream")


def _digest(content: str) -> str:
    """Return the expression of a content security policy that permits the style or script `content`."""
    return f"'sha256-{b64encode(sha256(content.encode()).digest()).decode()}'"


def resource(name: str) -> str:
    """Return the content of a file that is copied into the page unchanged."""
    return Path(__file__).with_name(name).read_text(encoding="utf-8")


def account_page(run: RecordedRun, parts: Sequence[PagePart] = ()) -> bytes:
    """Return the report of a run of any system. `parts` are the sections that the system adds to the report. Equal
    traces and results give equal pages.
    """
    came = outcome(run)
    said = title(run, came)
    top = element("header", element("h1", said), class_="failed" if came.failed else None)
    scripts = [part.script for part in parts if part.script]
    running = (element("script", Markup(script)) for script in scripts)
    body = element("body", top, element("main", *_account_sections(run, parts)), *running)
    name = printable(f"{run.trace.head.program}: {said}")
    style = resource("page.css") + "".join(part.style for part in parts)
    page = element("html", head(name, style, scripts), body, lang="en")
    return f"{MARK}{page}\n".encode()


def _account_sections(run: RecordedRun, parts: Sequence[PagePart]) -> Iterator[Markup]:
    yield section("account", "What happened", lines(account(run.trace.events)))
    yield from (part.markup for part in parts)
    yield timing_section(run)
    yield channels_section(run.trace)
    if run.result is not None and run.result.checks:
        yield section("referee", "What the referee measured", findings_table(run.result.checks))
    yield section("record", "World and versions", facts(run), *world_quantities(run))
