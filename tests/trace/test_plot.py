"""The plot of a trace: what it shows, and the file it is drawn to."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from conftest import Command
from recordings import EVENTS, record

from handeye.core.errors import InvalidInput
from handeye.core.units import DEGREE, INCH, OUNCE_FORCE
from handeye.program.events import GuardTripped, SystemEvent
from handeye.trace.plot import Plot, plot
from handeye.trace.reading import read_trace
from handeye.trace.trace import Trace


@pytest.fixture(scope="module")
def trace(tmp_path_factory: pytest.TempPathFactory) -> Trace:
    path = tmp_path_factory.mktemp("plot") / "a.mcap"
    record(path)
    return read_trace(path)


@pytest.fixture(scope="module")
def whole(trace: Trace) -> Plot:
    return plot(trace)


def curve(shown: Plot, name: str) -> np.ndarray:
    """The values of a curve, in whichever panel it is."""
    (found,) = (each for panel in shown.panels for each in panel.curves if each.name == name)
    return found.values


def test_people_see_degrees_inches_and_ounces(trace: Trace, whole: Plot) -> None:
    assert [panel.unit for panel in whole.panels] == ["deg", "in", "oz"]
    assert curve(whole, "wrist bend") == pytest.approx(trace.joints[:, 4] / DEGREE)
    assert curve(whole, "boom") == pytest.approx(trace.joints[:, 2] / INCH)
    assert curve(whole, "gap") == pytest.approx(trace.gaps / INCH)
    assert curve(whole, "z") == pytest.approx(trace.forces().force[:, 2] / OUNCE_FORCE, nan_ok=True)


class Crossed(SystemEvent, frozen=True, kw_only=True):
    """An event of a system's own."""


def test_events_of_a_system_are_marked_by_their_kind(trace: Trace) -> None:
    crossed = Crossed(time=1.0)
    marks = plot(replace(trace, events=(*trace.events, crossed))).marks
    assert [mark.times for mark in marks if mark.name == "Crossed"] == [(1.0,)]


def test_events_are_marked_when_they_happened(trace: Trace, whole: Plot) -> None:
    stops = [event.time for event in EVENTS if isinstance(event, GuardTripped)]
    assert {mark.name: list(mark.times) for mark in whole.marks}["stop"] == stops
    assert {mark.name for mark in whole.marks} == {"stop", "picture"}


def test_a_stage_alone_is_shown_from_its_beginning_to_its_end(trace: Trace) -> None:
    shown, stage = plot(trace, "clo"), trace.stages[1]
    assert (shown.begin, shown.end) == (stage.begin, stage.end)
    inside = (trace.times > stage.begin + 1e-4) & (trace.times <= stage.end + 1e-4)
    assert curve(shown, "gap") == pytest.approx(trace.gaps[inside] / INCH)


def test_a_stage_that_is_not_there_is_told(trace: Trace) -> None:
    with pytest.raises(InvalidInput, match=r"^there is no stage `paint`"):
        plot(trace, "paint")


@pytest.mark.parametrize(("name", "begins"), [("p.png", b"\x89PNG"), ("p.svg", b"<?xml"), ("p.pdf", b"%PDF")])
def test_the_same_trace_gives_the_same_file(
    command: Command, tmp_path: Path, name: str, begins: bytes
) -> None:
    record(tmp_path / "a.mcap")
    files = []
    for _ in range(2):
        assert command("trace", "plot", "a.mcap", "-o", name, "--overwrite")[0] == 0
        files.append(Path(name).read_bytes())
    assert files[0] == files[1]
    assert files[0].startswith(begins)


def test_a_plot_has_an_ending_that_is_known(command: Command, tmp_path: Path) -> None:
    record(tmp_path / "a.mcap")
    said = "handeye: the name of a plot must end in .png, .svg, .pdf, but `p.jpg` does not\n"
    assert command("trace", "plot", "a.mcap", "-o", "p.jpg") == (2, "", said)


def test_a_plot_without_matplotlib_is_told_with_the_way_to_get_it(
    command: Command, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    record(tmp_path / "a.mcap")
    monkeypatch.setitem(sys.modules, "matplotlib", None)
    code, _, err = command("trace", "plot", "a.mcap", "-o", "p.png")
    needed = "`trace plot` needs matplotlib, which is not installed"
    how = "`pip install matplotlib` installs it, and so does the extra `plot` of handeye"
    assert (code, err, Path("p.png").exists()) == (2, f"handeye: {needed}: {how}\n", False)
