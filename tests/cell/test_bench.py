"""A bench: its clock, its hooks, its events between steps, and what machines on it refuse."""

import mujoco
import numpy as np
import pytest

from handeye.cell.bench import Bench
from handeye.cell.bench_axes import BenchAxes, BenchOutputs, sensor, switch
from handeye.cell.mechanism import Mechanism
from handeye.core.errors import BadArgument, BadFile, HandeyeError, NoSuchName, PhysicsFailed, Refused
from handeye.execution.scheduler import Task, Until, run
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


def test_machines_that_put_goals_in_every_period_of_a_quarter_of_a_minute_stay_in_step(bench: Bench) -> None:
    machines = [
        BenchAxes(bench, [axis(name)], period=period, name=name)
        for name, period in (("a", 0.01), ("b", 1 / 60))
    ]

    def working(machine: BenchAxes) -> Task[float]:
        for _ in range(round(15 / machine.period)):
            machine.put(np.zeros(1))
            yield machine.period
        return bench.now

    assert run(bench, [working(machine) for machine in machines]) == [15.0, 15.0]
    assert bench.data.time == 15.0


def test_a_scene_changes_only_under_what_can_go_on_in_it() -> None:
    class Fixed(BenchOutputs):
        bind = Mechanism.bind

    spec = mujoco.MjSpec.from_string(SCENE)
    bench = Bench(spec.compile())
    axes = machine(bench)
    BenchOutputs(bench, "lamps", {})
    axes.put(np.array([0.05, 0.0]))
    bench.advance(1.0)
    spec.worldbody.add_geom(size=[0.1, 0.1, 0.1], pos=[9, 9, 9])
    bench.replace(spec)
    assert axes.read().q[0] == pytest.approx(0.05, abs=1e-3)
    Fixed(bench, "fixed", {})
    with pytest.raises(Refused, match=r"^fixed cannot continue in a changed scene$"):
        bench.replace(spec)


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
    with pytest.raises(NoSuchName, match=r"^the bench has no event drum; its events are bell$"):
        bench.call_at(0, "drum")
    bench.call_at(round(bench.now * 1e6) + 5001, "bell")
    bench.set_to_zero()
    bench.advance(0.01)
    assert heard[3:] == [pytest.approx(7 / 1200)]
    bench.call_at(round(bench.now * 1e6) + 5001, "bell")
    kept = bench.cell().capture()
    del bench.handlers["bell"]
    with pytest.raises(BadFile, match="the saved state contains events that this bench does not have"):
        bench.cell().restore(kept)


@pytest.mark.parametrize("hook", ["before_period", "before_step", "after_step"])
def test_an_event_that_a_hook_asks_for_is_not_late_even_while_all_sleeps(bench: Bench, hook: str) -> None:
    machine(bench)
    asked: list[float] = []
    heard: list[float] = []
    bench.handlers["bell"] = lambda: heard.append(bench.now)

    def ask() -> None:
        if not asked:
            asked.append(bench.now)
            bench.call_at(round(bench.now * 1e6) + 5000, "bell")

    getattr(bench, hook).append(ask)
    bench.advance(1 / 60)
    assert heard == pytest.approx([asked[0] + 0.005])
    bench.advance(1.0)
    asked.clear()
    bench.advance(100.0)
    assert not asked or heard[1] == pytest.approx(asked[0] + 0.005, abs=1e-3)


def test_events_that_never_end_or_let_time_pass_are_told(bench: Bench) -> None:
    bench.handlers["again"] = lambda: bench.call_at(0, "again")
    bench.handlers["wait"] = lambda: bench.advance(0.01)
    bench.call_at(5000, "wait")
    with pytest.raises(BadArgument, match=r"^time is already advancing on the bench: "):
        bench.advance(0.01)
    bench.call_at(0, "again")
    with pytest.raises(
        HandeyeError,
        match=r"^the events at 0.005 s cause an endless series of new events, all at this time; .* is again$",
    ):
        bench.advance(0.01)
    with pytest.raises(BadArgument, match=r"^an event at 1e\+10 s is too late; it must be before 1e\+09 s$"):
        bench.call_at(10**16, "again")


def test_a_task_waits_for_an_event_and_goes_on_when_it_happens(bench: Bench) -> None:
    ready: list[float] = []
    seen: list[float] = []
    bench.handlers["ready"] = lambda: ready.append(bench.now)
    bench.call_at(5000, "ready")

    def waiting() -> Task[None]:
        yield Until(met=lambda: bool(ready), name="a part")
        seen.append(bench.now)

    def resting() -> Task[None]:
        yield 0.1

    run(bench, [waiting(), resting()])
    assert (ready, seen) == ([0.005], [0.005])


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


def test_a_machine_without_power_sleeps_and_one_that_holds_keeps_its_grip() -> None:
    bench = Bench(mujoco.MjModel.from_xml_string(SCENE.replace('"1 0 0"/>', '"1 0 0" ref=".1"/>')))
    axes = machine(bench)
    bench.advance(1.0)
    assert axes.read().q == pytest.approx([0.1, 0.1])  # it stays where it was switched on
    bench.data.qfrc_applied[1] = -5.0
    axes.put(np.array([0.1, 0.11]))
    bench.advance(1.0)
    before = axes.read().q
    axes.power(False)
    bench.advance(1.0)
    assert axes.read().q == pytest.approx(before, abs=1e-4)
    bench.data.qfrc_applied[1] = 0.0
    made: list[None] = []
    bench.after_step.append(lambda: made.append(None))
    bench.advance(10.0)
    assert len(made) < 2 * 1200


@pytest.mark.parametrize("goal", [[0.1], [0.1, 0.1, 0.1], 0.1])
def test_a_goal_has_a_number_for_each_axis(bench: Bench, goal: object) -> None:
    with pytest.raises(BadArgument, match=r"^a goal of both must have 2 numbers, one for each axis$"):
        machine(bench).put(np.array(goal))


def test_what_a_machine_lacks_in_the_scene_or_senses_wrongly_is_told(bench: Bench) -> None:
    wide, narrow = Channel(name="a", width=2), Channel(name="a_1")
    with pytest.raises(BadArgument, match=r"^a machine cannot work in this scene: Invalid name 'c'"):
        BenchAxes(bench, [axis("c")], period=0.01)
    with pytest.raises(BadArgument, match=r"^a of axes has 2 values, not 1$"):
        BenchAxes(bench, [axis("a")], period=0.01, channels={wide: sensor("a")})
    with pytest.raises(PhysicsFailed, match=r"^range of axes shows a value that is not a finite number$"):
        BenchAxes(bench, [axis("a")], period=0.01, channels={Channel(name="range"): lambda *_: [np.inf]})
    with pytest.raises(BadArgument, match=r"need different names; the given names are a_1, a_2, a_1$"):
        BenchAxes(bench, [axis("a")], period=0.01, channels={wide: sensor("a"), narrow: sensor("a")})


def test_a_channel_that_changes_while_all_sleeps_is_latched(bench: Bench) -> None:
    lamp = [0.0]
    outputs = BenchOutputs(bench, "lamps", {"lamp": lambda value: lamp.__setitem__(0, value)})
    light = Channel(name="light", latched=True)
    axes = BenchAxes(bench, [axis("a"), axis("b")], period=0.01, channels={light: lambda *_: lamp})
    for value in (0.0, 1.0, 0.0):
        outputs.set("lamp", value)
        bench.advance(1.0)
    assert axes.read().channels == {"light": 1.0}


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
    with pytest.raises(NoSuchName, match=r"^there is no output bell; the outputs are lamp$"):
        outputs.set("bell", 1.0)
    with pytest.raises(BadArgument, match="is not a finite number"):
        outputs.set("lamp", np.nan)


def test_two_machines_of_one_name_cannot_be_kept(bench: Bench) -> None:
    machine(bench), machine(bench)
    with pytest.raises(ValueError, match="need different names; the given names are clock, both, both"):
        bench.cell()


def test_physics_that_fails_is_an_error_of_its_own(bench: Bench) -> None:
    bench.data.qvel[:] = 5000.0
    with pytest.raises(
        PhysicsFailed, match=r"^the simulated cell broke down \(something moves faster than 1000 "
    ):
        bench.advance(0.01)
