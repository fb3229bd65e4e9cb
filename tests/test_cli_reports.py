"""`handeye report`: a page of a run, or one sentence on why there is none."""

from collections.abc import Callable
from pathlib import Path

import pytest
from conftest import Command
from recordings import BODIES, record
from report_pages import tree
from short_runs import begin

from handeye.cli import job
from handeye.core import resources
from handeye.core.errors import InvalidInput
from handeye.report import animation, photographs
from handeye.report.facts.again import is_shipped
from handeye.report.page.document import MARK
from handeye.tasks.water_pump.task import WaterPump
from handeye.trace import channels, mcap_writer
from handeye.trace.reading import read_trace

pytestmark = pytest.mark.slow

Planned = Callable[[str], str]


@pytest.fixture(autouse=True)
def no_opengl(monkeypatch: pytest.MonkeyPatch) -> None:
    """A machine without OpenGL, on which a report is made all the same; the scene is put in by another test."""

    def fail(*_: object, **__: object) -> None:
        raise InvalidInput("OpenGL does not work on this machine")

    monkeypatch.setattr(photographs, "Photographer", fail)
    monkeypatch.setattr(animation, "scene_bytes", lambda _: b"scene")


@pytest.fixture
def kept(command: Command, planned: Planned) -> Path:
    """The folder of a run of one step."""
    assert command("run", planned("OPEN 1"), "--camera", "ray", "--out", "kept")[0] == 0
    return Path("kept")


def refused(command: Command, *words: str) -> str:
    """The sentence with which a command is refused, which leaves nothing behind."""
    before = {path for path in Path().rglob("*") if path.suffix != ".mcap"}
    code, out, err = command("report", *words)
    assert (code, out) == (2, "")
    assert {path for path in Path().rglob("*") if path.suffix != ".mcap"} == before
    return err.removeprefix("handeye: ").rstrip("\n")


def test_the_folder_of_a_run_of_one_step_gets_its_page(command: Command, kept: Path) -> None:
    code, out, _ = command("report", "kept")
    assert (code, out) == (0, "kept/report.html\n")
    page = tree((kept / "report.html").read_text(encoding="utf-8"))
    assert page.all("h1")[0].text == "The program finished."
    assert "No photograph: OpenGL does not work on this machine." in page.text


def test_a_report_in_the_folder_of_its_run_is_renewed_and_one_elsewhere_only_on_request(
    command: Command, kept: Path
) -> None:
    assert command("report", "kept")[1] == "kept/report.html\n"
    assert command("report", "kept")[1] == "kept/report.html; the earlier file is replaced\n"
    assert command("report", "kept", "-o", "page.html")[0] == 0
    assert refused(command, "kept", "-o", "page.html") == "page.html already exists; --overwrite replaces it"
    assert command("report", "kept", "-o", "page.html", "--overwrite")[0] == 0


def test_a_run_that_goes_on_loses_the_report_of_what_it_was(command: Command, planned: Planned) -> None:
    plan = planned('STAGE "one"\nOPEN 1\nSTAGE "two"\nOPEN 2')
    assert command("run", plan, "--camera", "ray", "--out", "kept", "--to", "one")[0] == 0
    assert command("report", "kept")[0] == 0
    assert command("resume", "kept")[0] == 0
    assert not Path("kept/report.html").exists()


def test_no_such_run(command: Command) -> None:
    assert refused(command, "nowhere", "-o", "page.html") == "nowhere: there is no such file"


def test_an_event_list_does_not_say_where_things_were(command: Command) -> None:
    Path("events.jsonl").write_text("", encoding="utf-8")
    assert refused(command, "events.jsonl", "-o", "page.html") == (
        "events.jsonl is an event list, which holds no positions; use the trace.mcap"
    )


def test_what_is_no_trace(command: Command) -> None:
    Path("poem.txt").write_text("roses", encoding="utf-8")
    assert (
        refused(command, "poem.txt", "-o", "page.html") == "poem.txt is not a trace: it is not an MCAP file"
    )


def test_a_file_of_somebody_is_left_alone(command: Command, kept: Path) -> None:
    Path("page.html").write_text("<p>mine</p>", encoding="utf-8")
    assert refused(command, "kept", "-o", "page.html") == (
        "page.html exists and is not a report of handeye; nothing was written"
    )


def test_a_name_that_browsers_do_not_open(command: Command, kept: Path) -> None:
    assert refused(command, "kept", "-o", "page.txt") == (
        "page.txt: the name of the report of handeye must end in .html"
    )


def test_a_folder_that_is_not_there(command: Command, kept: Path) -> None:
    assert refused(command, "kept", "-o", "nowhere/page.html") == (
        "nowhere/page.html cannot be written: No such file or directory"
    )


def test_a_trace_of_a_newer_version(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(mcap_writer, "VERSION", channels.VERSION + 1)
        record(Path("new.mcap"))
    assert refused(command, "new.mcap", "-o", "page.html").startswith("new.mcap has trace format version 5")


def test_a_trace_of_another_scene(command: Command) -> None:
    record(Path("other.mcap"))
    assert f"`{BODIES[1]}`" in refused(command, "other.mcap", "-o", "page.html")


def test_a_damaged_trace(command: Command) -> None:
    data = bytearray(record(Path("bad.mcap")))
    data[len(data) // 2] ^= 1
    Path("bad.mcap").write_bytes(data)
    assert refused(command, "bad.mcap", "-o", "page.html") == "bad.mcap is damaged"


def test_a_trace_that_was_cut_short_is_shown_as_far_as_it_goes(command: Command, kept: Path) -> None:
    data = (kept / "trace.mcap").read_bytes()
    Path("cut.mcap").write_bytes(data[: len(data) - 40])
    assert command("report", "cut.mcap", "-o", "page.html")[0] == 0
    assert "The trace is truncated" in Path("page.html").read_text(encoding="utf-8")


def test_a_report_of_an_assembly_needs_a_folder(command: Command) -> None:
    code, _, err = command("assemble", "--report", "--no-keep")
    sentence = (
        "handeye: --report writes a page into the folder of the run, but with --no-keep there is no folder; "
        "leave out one of these two options\n"
    )
    assert (code, err) == (2, sentence)


def test_a_run_leaves_its_report(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(WaterPump, "photographs", ())
    assert job.work(job.Job(start=begin("OPEN 1"), out=tmp_path, report=True)) == 0
    assert "\nreport: " in capsys.readouterr().err
    assert (tmp_path / "report.html").exists()


def test_a_run_is_what_it_is_whatever_comes_of_its_report(
    tmp_path: Path, capsys: pytest.CaptureFixture[str], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(WaterPump, "photographs", ())
    monkeypatch.setattr(job, "REPORT", "report.txt")
    assert job.work(job.Job(start=begin("OPEN 1"), out=tmp_path, report=True)) == 0
    assert "no report is written: " in capsys.readouterr().err


def test_a_report_is_known_by_how_it_begins(command: Command, kept: Path) -> None:
    assert command("report", "kept", "-o", "page.html")[0] == 0
    assert Path("page.html").read_bytes().startswith(MARK.encode())


def test_the_demo_is_a_page_of_twelve_stages_made_without_opengl(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(WaterPump, "photographs", ("studio", "pump"))
    code, out, _ = command("report", "--demo")
    assert (code, out) == (0, "demo.html\n")
    page = tree(Path("demo.html").read_text(encoding="utf-8"))
    assert page.all("h1")[0].text == "The pump is assembled."
    assert [image.attributes["alt"] for image in page.all("header")[0].all("img")] == ["The end of the run"]
    assert len(page.one("stages").all("a")) == 12
    assert len(page.one("seen").all("figure")) == 6
    assert "This trace is thinned" in page.one("felt").text
    assert "No photograph: OpenGL does not work on this machine." in page.one("run").text


def test_the_demo_is_of_the_plan_that_comes_with_handeye() -> None:
    """Else its page would tell a command that cannot be carried out."""
    assert is_shipped(read_trace(resources.demo() / "trace.mcap").head.plan), "run: python docs/make_demo.py"


def test_the_demo_takes_less_than_an_eighth_of_a_megabyte_for_a_minute_of_its_run() -> None:
    minutes = read_trace(resources.demo() / "trace.mcap").times[-1] / 60
    others = sum(
        file.stat().st_size for name in resources.recorded() for file in (resources.demo() / name).iterdir()
    )
    assert sum(file.stat().st_size for file in resources.demo().rglob("*")) - others < 125_000 * minutes


def test_the_demonstration_brings_its_own_run(command: Command) -> None:
    assert refused(command, "kept", "--demo") == "--demo has its own run; give either a run or --demo"


def test_a_picture_that_a_run_has_left_and_nobody_can_read_is_missing(
    command: Command, kept: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(WaterPump, "photographs", ("studio", "pump"))
    (kept / "pictures" / "end_pump.png").write_bytes(b"no picture")
    assert command("report", "kept")[0] == 0
    page = tree((kept / "report.html").read_text(encoding="utf-8"))
    assert page.all("header")[0].all("img") == []


def test_a_trace_is_thinned_where_nothing_is_yet(command: Command, kept: Path) -> None:
    assert command("trace", "thin", "kept", "-o", "thin.mcap")[0] == 0
    assert command("trace", "thin", "kept", "-o", "thin.mcap")[2].endswith("--overwrite replaces it\n")
    code, _, err = command("trace", "thin", "kept", "-o", "kept/trace.mcap", "--overwrite")
    assert (code, err) == (2, "handeye: kept/trace.mcap is the trace to be thinned; choose another file\n")
