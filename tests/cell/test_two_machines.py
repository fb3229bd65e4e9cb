"""Two machines of different periods on one bench: an hour, killed and resumed, and their channels.

The hour is two seconds of work, whose physics are simulated; the rest passes at once while everything sleeps.
"""

from pathlib import Path

import numpy as np
import pytest
from conftest import Command
from two_machines import TwoMachines, begin_hour

from handeye.runs.advance import advance
from handeye.runs.checkpoint_file import decode, encode
from handeye.runs.folder import TRACE, open_again, open_new
from handeye.runs.runner import Runner
from handeye.trace.plot import plot
from handeye.trace.reading import read_trace
from handeye.view.moment import Newest

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def hour(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of an hour that was not broken off."""
    path, start = tmp_path_factory.mktemp("hour") / "run", begin_hour()
    keeping = open_new(path, start)
    runner = Runner(start, observers=lambda runner: [keeping.watch(runner, start, again=False)])
    advance(runner)
    runner.finish()
    keeping.close()
    return path


def test_an_hour_passes_without_drift_and_all_is_asleep_in_its_rests() -> None:
    runner = Runner(begin_hour())
    system = runner.system
    assert isinstance(system, TwoMachines)
    made: list[None] = []
    system.bench.after_step.append(lambda: made.append(None))
    advance(runner)
    assert (runner.time, system.bench.data.time, system.rings) == (3600.0, 3600.0, 6 + 1)
    assert len(made) < 3 * 1200  # of 3600 * 1200 physics steps
    assert system.gripper.read().q == pytest.approx(np.zeros(3), abs=1e-4)
    assert set(system.lamps) == {0.0, 1.0}


def test_an_hour_that_is_killed_and_resumed_ends_in_the_same_bytes(hour: Path, tmp_path: Path) -> None:
    start = begin_hour()
    keeping = open_new(tmp_path / "run", start)
    runner = Runner(start, observers=lambda runner: [keeping.watch(runner, start, again=False)])
    advance(runner, steps=1)
    keeping.close()
    folder, kept, _ = open_again(tmp_path / "run")
    resumed = Runner(kept, observers=lambda runner: [folder.watch(runner, kept, again=True)])
    advance(resumed)
    resumed.finish()
    folder.close()
    assert (tmp_path / "run" / TRACE).read_bytes() == (hour / TRACE).read_bytes()


def test_an_hour_goes_on_to_the_same_bytes_from_a_state_in_its_middle() -> None:
    unbroken, broken = Runner(begin_hour()), Runner(begin_hour())
    advance(unbroken)
    advance(broken, steps=2)
    resumed = Runner(decode(encode(broken.checkpoint()), "it"))
    assert resumed.time == 1800.0
    advance(resumed)
    assert encode(resumed.checkpoint()) == encode(unbroken.checkpoint())


def test_its_channels_are_in_trace_and_plot(hour: Path) -> None:
    trace = read_trace(hour / TRACE)
    curves = {curve.name: curve for curve in trace.channels}
    assert [(curve.name, curve.unit) for curve in trace.channels] == [
        ("gripper.pad", ""), ("gripper.ever", ""), ("pusher.range", "m"),
    ]  # fmt: skip
    pad, ever = curves["gripper.pad"].values, curves["gripper.ever"].values
    assert (pad[0], pad.max(), pad[-1]) == (0.0, 1.0, 0.0)
    assert (ever[0], ever[-1]) == (0.0, 1.0)  # latched
    assert curves["pusher.range"].values[-1] == pytest.approx(0.4 - 0.041, abs=1e-3)
    assert {panel.name: panel.unit for panel in plot(trace).panels}["channels"] == "m"


def test_its_channels_are_in_csv_and_report(hour: Path, tmp_path: Path, command: Command) -> None:
    code, _, err = command("trace", "export", "csv", str(hour / TRACE), "-o", str(tmp_path / "tables"))
    assert code == 0, err
    head = (tmp_path / "tables" / "channels.csv").read_text(encoding="utf-8").splitlines()[0]
    assert head == "time,stage,step,file,line,gripper.pad,gripper.ever,pusher.range"
    code, _, err = command("report", str(hour), "-o", str(tmp_path / "page.html"))
    assert code == 0, err
    page = (tmp_path / "page.html").read_text(encoding="utf-8")
    assert ['aria-label="gripper.pad: 0 to 1"' in page, "pusher.range" in page] == [True, True]


def test_its_channels_are_in_the_live_view() -> None:
    runner = Runner(begin_hour(), observers=lambda runner: [Newest(runner)])
    (newest,) = [each for each in runner.observers if isinstance(each, Newest)]
    advance(runner, steps=1)
    assert newest.parts == (("gripper.pad", ""), ("gripper.ever", ""), ("pusher.range", "m"))
    assert newest.moment.channels.tolist() == pytest.approx([0.0, 1.0, 0.359], abs=4e-3)
