"""A bench: its clock, its hooks, its events between steps, and what machines on it refuse."""

import mujoco
import numpy as np
import pytest

from handeye.cell.bench import Bench
from handeye.cell.bench_axes import BenchAxes, BenchOutputs, switch
from handeye.core.errors import BadArgument, BadFile, NoSuchName, PhysicsFailed, Refused
from handeye.ports.axes import AxisSpec, Channel

SCENE = """<mujoco><option timestep=".00083333333333" gravity="0 0 0"><flag sleep="enable"/></option><worldbody>
<body name="a"><joint name="a" type="slide" axis="1 0 0"/><geom size=".01" mass="1"/></body>
<body name="b" pos="0 0 1"><joint name="b" type="slide" axis="1 0 0"/><geom size=".01" mass="1"/></body></worldbody>
<actuator><position name="a" joint="a" kp="1000" kv="60"/><position name="b" joint="b" kp="1000" kv="60"/></actuator>
<sensor><jointpos name="a" joint="a"/></sensor></mujoco>"""
FAR = Channel(name="far", latched=True)


def axis(name: str, *, holds: bool = False) -> AxisSpec:
    return AxisSpec(name=name, kind="prismatic", lower=-1, upper=1, speed=1, force=20.0, holds=holds)


@pytest.fixture
def bench() -> Bench:
    return Bench(mujoco.MjModel.from_xml_string(SCENE))


def machine(bench: Bench, name: str = "both") -> BenchAxes:
    specs = [axis("a"), axis("b", holds=True)]
    return BenchAxes(bench, specs, period=0.01, name=name, channels={FAR: switch("a", above=0.02)})


def test_periods_of_ten_milliseconds_and_a_sixtieth_add_up_exactly(bench: Bench) -> None:
    for _ in range(6):
        bench.advance(0.01)
    for _ in range(60):
        bench.advance(1 / 60)
    assert (bench.now, bench.data.time) == (1.06, 1.06)


def test_an_event_happens_before_the_first_step_at_its_time_and_belongs_to_the_state(bench: Bench) -> None:
    heard: list[float] = []
    bench.handlers["bell"] = lambda: heard.append(bench.now)
    for microseconds in (3000, 1000):
        bench.call_at(microseconds, "bell")
    bench.advance(1 / 600)
    kept = bench.cell().capture()
    bench.advance(0.01)
    assert heard == [pytest.approx(2 / 1200), pytest.approx(4 / 1200)]
    bench.cell().restore(kept)
    bench.advance(0.01)
    assert heard[2:] == heard[1:2]
    with pytest.raises(NoSuchName, match=r"^nothing on the bench is called drum; there are bell$"):
        bench.call_at(0, "drum")
    del bench.handlers["bell"]
    with pytest.raises(BadFile, match="it waits for events that this bench does not know"):
        bench.cell().restore(kept)


def test_hooks_are_called_around_steps_and_periods_of_a_sixtieth(bench: Bench) -> None:
    called: list[str] = []
    for name in ("before_period", "before_step", "after_step", "after_period"):
        getattr(bench, name).append(lambda name=name: called.append(name))
    machine(bench).put(np.array([0.1, 0.0]))
    bench.advance(1 / 30)
    once = ["before_period", *20 * ["before_step", "after_step"], "after_period"]
    assert called == 2 * once


def test_power_that_is_off_lets_go_of_what_does_not_hold_by_itself(bench: Bench) -> None:
    axes = machine(bench)
    axes.put(np.array([0.05, 0.05]))
    bench.advance(1.0)
    axes.power(False)
    with pytest.raises(Refused, match=r"^the power of both is off$"):
        axes.put(np.zeros(2))
    bench.data.qfrc_applied[:] = 1.0
    bench.advance(0.2)
    bench.data.qfrc_applied[:] = 0.0
    slack, held = axes.read().q
    assert (slack > 0.06, held) == (True, pytest.approx(0.05, abs=2e-3))
    axes.power(True)
    bench.advance(1.0)
    assert axes.read().q[0] == pytest.approx(slack, abs=0.05)


def test_a_latched_channel_stays_until_it_is_cleared(bench: Bench) -> None:
    axes = machine(bench)
    for goal in (0.05, 0.0):
        axes.put(np.array([goal, 0.0]))
        bench.advance(1.0)
    assert axes.read().channels == {"far": 1.0}
    axes.clear("far")
    assert axes.read().channels == {"far": 0.0}
    with pytest.raises(NoSuchName, match=r"^both has no latched channel near$"):
        axes.clear("near")


def test_outputs_are_set_by_name_and_kept(bench: Bench) -> None:
    lit: list[float] = []
    outputs = BenchOutputs(bench, "lamps", {"lamp": lit.append})
    outputs.set("lamp", 1.0)
    kept = bench.cell().capture()
    outputs.set("lamp", 0.0)
    bench.cell().restore(kept)
    bench.advance(0.01)
    assert lit == [1.0]
    with pytest.raises(NoSuchName, match=r"^there is no output bell; there are lamp$"):
        outputs.set("bell", 1.0)
    with pytest.raises(BadArgument, match="is not a finite number"):
        outputs.set("lamp", np.nan)


def test_two_machines_of_one_name_cannot_be_kept(bench: Bench) -> None:
    machine(bench), machine(bench)
    with pytest.raises(ValueError, match="have names of their own; these are clock, both, both"):
        bench.cell()


def test_physics_that_fails_is_an_error_of_its_own(bench: Bench) -> None:
    bench.data.qvel[:] = 5000.0
    with pytest.raises(
        PhysicsFailed, match=r"^the simulated cell broke down \(something moves faster than 1000 "
    ):
        bench.advance(0.01)
