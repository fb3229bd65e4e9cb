"""The report of a run is one page that fetches nothing, runs nothing but its own script, and says what is."""

import re
from base64 import b64encode
from hashlib import sha256
from pathlib import Path

import pytest
from recordings import BOUNDARIES, Recording
from report_pages import Node, barriers, page_of, recorded, renamed, tree

from handeye.report.recorded import RecordedRun
from handeye.tasks import known
from handeye.trace.reading import read_trace

EVIL = "</script><img src=x onerror=alert(1)>"


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    return recorded(tmp_path_factory.mktemp("run") / "trace.mcap")


@pytest.fixture(scope="module")
def page(run: RecordedRun) -> Node:
    return tree(page_of(run))


def hashed(content: str) -> str:
    return f"'sha256-{b64encode(sha256(content.encode()).digest()).decode()}'"


def test_the_policy_lets_in_its_own_script_and_style_and_pictures_in_the_file(page: Node) -> None:
    (policy,) = (meta.attributes["content"] for meta in page.all("meta") if "http-equiv" in meta.attributes)
    rules = dict(rule.strip().split(" ", 1) for rule in (policy or "").split(";"))
    scripts = [hashed(node.text) for node in page.all("script") if "type" not in node.attributes]
    styles = [hashed(node.text) for node in page.all("style")]
    assert rules == {
        "default-src": "'none'",
        "script-src": " ".join(scripts),
        "style-src": " ".join(styles),
        "img-src": "data: blob:",
    }


def test_it_fetches_nothing(run: RecordedRun, page: Node) -> None:
    addresses = [node.attributes.get(key) or "" for node in page for key in ("src", "href")]
    assert {address.split(":")[0] for address in addresses if address[:1] not in ("", "#")} == {"data"}
    assert re.findall(r"https?:|//\w|url\(|@import", page_of(run)) == []


def test_it_has_no_style_and_no_script_in_attributes(page: Node) -> None:
    names = {name for node in page for name in node.attributes}
    assert {name for name in names if name == "style" or name.startswith("on")} == set()


def test_the_same_trace_gives_the_same_page(run: RecordedRun, tmp_path: Path) -> None:
    assert page_of(recorded(tmp_path / "again.mcap")) == page_of(run)


def test_its_sections_stand_in_order(page: Node) -> None:
    assert [node.attributes["id"] for node in page.all("section") if "aria-labelledby" in node.attributes] == [
        "run", "timing", "seen", "felt", "planned", "referee", "record",
    ]  # fmt: skip


def test_the_times_of_1973_come_with_what_was_timed(
    run: RecordedRun, monkeypatch: pytest.MonkeyPatch
) -> None:
    pump = known("water_pump")
    assert pump is not None
    monkeypatch.setattr(RecordedRun, "period", pump.period)
    timing = tree(page_of(run)).one("timing").text
    assert "compared with 1973" in timing
    assert "The job of 1973 had eleven steps." in timing


def test_nothing_keeps_people_who_do_not_see_or_point_from_it(page: Node) -> None:
    assert list(barriers(page)) == []


def test_names_are_used_once(page: Node) -> None:
    names = [node.attributes["id"] for node in page if "id" in node.attributes]
    assert len(names) == len(set(names))


@pytest.mark.parametrize("word", ["stage", "text", "program"])
def test_whatever_a_name_is_it_is_shown_as_its_characters(run: RecordedRun, word: str) -> None:
    hostile = tree(page_of(renamed(run, **{word: EVIL})))
    plain = tree(page_of(run))
    assert EVIL in hostile.text
    assert [node.name for node in hostile if node.name in ("img", "script")] == [
        node.name for node in plain if node.name in ("img", "script")
    ]


def test_what_cannot_be_seen_is_not_hidden(run: RecordedRun) -> None:
    page = tree(page_of(renamed(run, stage="open\u202e")))
    assert page.one("felt").all("h3")[0].text == "open\N{REPLACEMENT CHARACTER}"


def test_every_control_has_a_name_and_a_key(page: Node) -> None:
    controls = [node for node in page if node.name in ("button", "input", "select")]
    named = [
        node.text.strip() or node.attributes.get("aria-label") or node.attributes["id"] for node in controls
    ]
    assert all(named)
    assert [node.attributes["id"] for node in controls if "aria-keyshortcuts" not in node.attributes] == []


def test_every_picture_and_drawing_says_what_it_shows_or_that_it_adds_nothing(page: Node) -> None:
    shown = [node for node in page if node.name in ("img", "svg", "canvas")]
    told = [{"alt", "aria-label", "aria-hidden"} & {*node.attributes} for node in shown]
    assert shown
    assert all(told)


def test_a_figure_leads_somewhere_by_its_caption(page: Node) -> None:
    """A link around a drawing would be named after the words in the drawing, too."""
    links = [link for figure in page.all("figure") for link in figure.all("a")]
    assert links
    assert [link.text for link in links if not link.text.strip() or link.all("svg")] == []


def test_the_figures_lead_to_moments_of_the_run(run: RecordedRun, page: Node) -> None:
    links = [node.attributes["href"] or "" for node in page.all("a")]
    moments = [float(link[3:]) for link in links if link.startswith("#t=")]
    assert moments
    assert all(0 <= moment <= run.ends + 0.01 for moment in moments)


def test_the_contents_link_every_section(page: Node) -> None:
    (contents,) = [nav for nav in page.all("nav") if nav.attributes.get("aria-label") == "contents"]
    named = [node for node in page.all("section") if "aria-labelledby" in node.attributes]
    assert [(link.attributes["href"], link.text) for link in contents.all("a")] == [
        (f"#{node.attributes['id']}", next(iter(node.all("h2"))).text) for node in named
    ]


def test_guarded_motions_of_a_run_without_failure_are_folded_by_stage(page: Node) -> None:
    folds = page.one("felt").all("details")
    assert [fold.all("h3")[0].text for fold in folds] == ["open", "close", "again"]
    assert not [fold for fold in folds if "open" in fold.attributes]


def test_a_guarded_motion_has_a_figure_with_its_line_and_its_trip(page: Node) -> None:
    figures = list(page.one("felt").all("figure"))
    dots = [node for node in page.one("felt").all("circle") if node.attributes.get("class") == "trip"]
    assert (len(figures), len(dots)) == (9, 9)
    assert figures[0].text.endswith("9.0 N; limit 8.0 N (28.78 oz)")


def test_a_picture_is_there_with_what_was_found_over_it(page: Node) -> None:
    (figure,) = page.one("seen").all("figure")
    assert [node.name for node in figure.all("svg")[0]] == ["svg", "polygon", "line", "circle"]
    assert page.one("marks").attributes["type"] == "checkbox"


def beginning(path: Path, events: int, *, whole: bool = True) -> Node:
    """The page of the first events of the run."""
    Recording(path).begin().play(0, events).close()
    return tree(page_of(RecordedRun(trace=read_trace(path), whole=whole)))


def test_a_run_without_pictures_says_so(tmp_path: Path) -> None:
    assert "This run took no picture." in beginning(tmp_path / "trace.mcap", 12).one("seen").text


def test_a_trace_without_motion_gives_a_page(tmp_path: Path) -> None:
    page = beginning(tmp_path / "trace.mcap", 2)
    assert page.all("h1")[0].text == "The run is paused."
    assert "No motion of this run had a guard" in page.one("felt").text


def test_a_trace_that_was_cut_short_says_so(tmp_path: Path) -> None:
    page = beginning(tmp_path / "trace.mcap", 12, whole=False)
    assert page.all("h1")[0].text == "The recording breaks off at line 2."
    assert "is truncated" in page.all("header")[0].text


def test_a_run_taken_up_from_a_checkpoint_says_what_it_has_not_seen(tmp_path: Path) -> None:
    taken_up = BOUNDARIES[2]
    Recording(tmp_path / "trace.mcap").resume(taken_up).play(taken_up).close()
    page = tree(page_of(RecordedRun(trace=read_trace(tmp_path / "trace.mcap"))))
    assert "resumed from a checkpoint" in page.all("header")[0].text
    told = [bar.attributes["aria-label"] or "" for bar in page.one("stages").all("a")]
    assert [bar.endswith("not recorded") for bar in told] == [True, True, False]
    assert "1 picture was taken before this trace begins" in page.one("seen").text
    assert "6 guards tripped before this trace begins" in page.one("felt").text
    assert len(page.one("felt").all("figure")) == 3


def test_without_photographs_it_says_why(page: Node) -> None:
    assert "No photograph: none was wanted." in page.all("header")[0].text


def colours(style: str) -> list[dict[str, str]]:
    """The colours of light and of dark pages, by name."""
    return [
        dict(re.findall(r"--(\w+): (#[0-9a-f]{6})", block))
        for block in style.split("prefers-color-scheme")[:2]
    ]


def luminance(colour: str) -> float:
    levels = [int(colour[at : at + 2], 16) / 255 for at in (1, 3, 5)]
    r, g, b = (c / 12.92 if c <= 0.04045 else ((c + 0.055) / 1.055) ** 2.4 for c in levels)
    return 0.2126 * r + 0.7152 * g + 0.0722 * b


def test_words_stand_out_from_paper_in_light_and_dark(page: Node) -> None:
    for scheme in colours(page.all("style")[0].text):
        for ink in ("ink", "soft", "blue", "red", "green", "amber"):
            for ground in ("paper", "sheet"):
                low, high = sorted((luminance(scheme[ink]), luminance(scheme[ground])))
                assert (high + 0.05) / (low + 0.05) >= 4.5, (ink, ground)
