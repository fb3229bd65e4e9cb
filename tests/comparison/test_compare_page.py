"""The page of two runs: one file, whatever they are called, with what was found and both to walk round in."""

import json
from pathlib import Path

import msgspec
import pytest
from conftest import Command
from recordings import record
from report_pages import Node, barriers, changed, recorded, renamed, tree

from handeye.comparison.comparison import comparison
from handeye.comparison.page import comparison_page
from handeye.core.errors import InvalidInput
from handeye.program.events import AnyEvent, GuardTripped
from handeye.program.guards import GuardKind
from handeye.report import animation
from handeye.report.animation import Animation
from handeye.report.recorded import RecordedRun

EVIL = "</script><img src=x onerror=alert(1)>"


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    return recorded(tmp_path_factory.mktemp("page") / "a.mcap")


def page_of(a: RecordedRun, b: RecordedRun) -> str:
    """The page of two runs, with something in the place of their animations."""
    shown = Animation(scene=b"scene", tracks=b"tracks")
    return comparison_page(a, b, comparison(a, b), (shown, shown)).decode()


def heading(page: Node) -> str:
    (found,) = page.all("h1")
    return found.text


def test_the_heading_says_what_came_of_it(run: RecordedRun) -> None:
    assert heading(tree(page_of(run, run))) == "Both runs are identical, to the last bit."


def test_the_page_of_diverging_runs_says_so_in_its_head_and_opens_just_after(run: RecordedRun) -> None:
    def stopped(event: AnyEvent) -> AnyEvent:
        return (
            msgspec.structs.replace(event, guard=GuardKind.MOMENT)
            if isinstance(event, GuardTripped)
            else event
        )

    page = tree(page_of(run, changed(run, stopped)))
    assert heading(page) == "A and B diverge in the stage “open”."
    (head,) = page.all("header")
    ((step, words),) = [(node.attributes["href"], node.text) for node in head.all("a")]
    legs = json.loads(page.one("moments").text)
    at = next(n for n, leg in enumerate(legs) if leg[3] == words)
    assert step == f"#t={legs[at][0]:.2f}"
    assert legs[at + 1][0] < float(page.one("time").attributes["value"]) < legs[at + 2][0]
    assert page_of(run, run).count('value="0.00"') == 1


def test_nothing_keeps_people_who_do_not_see_or_point_from_it(run: RecordedRun) -> None:
    assert list(barriers(tree(page_of(run, run)))) == []


def test_both_views_stand_under_one_slider(run: RecordedRun) -> None:
    page = tree(page_of(run, run))
    assert [node.attributes["id"] for node in page.all("canvas")] == [
        "view-a",
        "senses-a",
        "view-b",
        "senses-b",
    ]
    assert len([node for node in page.all("input") if node.attributes["type"] == "range"]) == 1
    for name in ("scene-a", "tracks-a", "scene-b", "tracks-b"):
        assert page.one(name).attributes["type"] == "application/octet-stream"
    for name in ("sensed-a", "sensed-b"):
        assert json.loads(page.one(name).text)["tools"]


def test_the_script_is_told_where_both_runs_stand(run: RecordedRun) -> None:
    legs = json.loads(tree(page_of(run, run)).one("moments").text)
    begun = [step for step in legs if step[3]]
    assert len(begun) == 9
    assert begun[0] == [0.0, 0.0, 0.0, "open, line 2: OPEN 1", "open, line 2: OPEN 1"]
    assert legs[-1][:3] == pytest.approx([run.ends] * 3)


def test_what_a_run_is_called_stays_text(run: RecordedRun) -> None:
    page = page_of(run, renamed(run, stage=EVIL, text=EVIL, program=EVIL))
    assert tree(page).all("img") == []
    assert EVIL not in page


def test_the_same_traces_give_the_same_page(run: RecordedRun) -> None:
    assert page_of(run, run) == page_of(run, run)


# -- the command ---------------------------------------------------------------------------------------------


@pytest.fixture
def traces(command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """Two traces, whose scene this test does not draw."""
    monkeypatch.setattr(animation, "scene_bytes", lambda _: b"scene")
    monkeypatch.setattr("handeye.report.recorded.check_scene", lambda _: None)
    for name in ("a.mcap", "b.mcap"):
        record(tmp_path / name)


@pytest.mark.usefixtures("traces")
@pytest.mark.parametrize("word", ["compare", "report"])
def test_both_commands_write_the_page(command: Command, word: str) -> None:
    code, _, err = command(word, "a.mcap", "b.mcap", "-o", "page.html")
    assert (code, err) == (0, "page: page.html\n" if word == "compare" else "")
    page = tree(Path("page.html").read_text(encoding="utf-8"))
    assert heading(page) == "Both runs are identical, to the last bit."
    assert not [node for node in page.all("p") if node.attributes.get("class") == "missing" and node.text]


@pytest.mark.usefixtures("traces")
def test_a_page_is_replaced_only_if_somebody_says_so_and_nothing_else_ever(command: Command) -> None:
    words = ("compare", "a.mcap", "b.mcap", "-o", "page.html")
    assert command(*words)[0] == 0
    said = "handeye: page.html already exists; --overwrite replaces it\n"
    assert command(*words) == (2, "", said)
    assert command(*words, "--overwrite")[0] == 0
    Path("page.html").write_text("mine", encoding="utf-8")
    assert command(*words, "--overwrite")[2].startswith(
        "handeye: page.html exists and is not a comparison of handeye"
    )


@pytest.mark.usefixtures("traces")
def test_a_report_of_two_runs_has_to_be_told_its_place(command: Command) -> None:
    said = "handeye: a page of two runs has no default place; choose a file with -o\n"
    assert command("report", "a.mcap", "b.mcap") == (2, "", said)


@pytest.mark.usefixtures("traces")
def test_without_a_scene_the_page_says_so_and_has_all_else(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    def lacking(_: RecordedRun) -> None:
        raise InvalidInput("a.mcap belongs to another scene: the scene shown here has no `base`")

    monkeypatch.setattr("handeye.report.recorded.check_scene", lacking)
    assert command("compare", "a.mcap", "b.mcap", "-o", "page.html")[0] == 0
    page = tree(Path("page.html").read_text(encoding="utf-8"))
    said = "There is no 3D view: a.mcap belongs to another scene: the scene shown here has no `base`."
    assert said in [node.text for node in page.all("p")]
    assert [node.attributes["id"] for node in page.all("section") if "aria-labelledby" in node.attributes][
        :2
    ] == ["run", "differences"]
