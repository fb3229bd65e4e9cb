"""The thread model on a bench of its own."""

from functools import cache
from math import pi

import mujoco
import numpy as np
import pytest
from thread_bench import HEAD, LENGTH, MOUTH, SPEED, STOP, Outcome, ThreadBench, drive_screw, scene

from handeye.cell.arm import Watchdog
from handeye.cell.bench import Bench
from handeye.cell.bench_axes import BenchAxes, BenchOutputs
from handeye.cell.hand import SimulatedScrewdriver
from handeye.cell.threads import ThreadFigures, Threads
from handeye.core.errors import BadArgument
from handeye.core.units import JIFFY
from handeye.ports.axes import AxisSpec, Channel


@cache
def outcome(offset: float = 0.0, tilt: float = 0.0) -> Outcome:
    return drive_screw(offset=offset, tilt=tilt)


@pytest.mark.parametrize(("offset", "tilt"), [(0.0, 0.0), (0.0005, 0.0), (0.0, 0.045)])
def test_an_aligned_screw_seats_and_stalls_the_motor(offset: float, tilt: float) -> None:
    end = outcome(offset, tilt)
    assert end.torque > 0.28
    assert abs(end.height) < 2e-4  # m: soft contact under the clamp
    assert not end.thread.crossed


def test_a_seated_screw_clamps_what_lies_under_its_head() -> None:
    assert 100 < outcome().thread.clamp < 250  # N; the study measured 113-175 N at .3 N m


@pytest.mark.slow
def test_a_screw_two_millimetres_off_never_engages_and_meets_no_torque() -> None:
    end = outcome(offset=0.002)
    assert end.thread.screw is None
    assert end.torque < 0.06
    assert end.height > 0.005


def test_a_screw_that_is_turned_too_slowly_never_engages() -> None:
    assert drive_screw(speed=2.5, seconds=4.0).thread.screw is None


def test_a_tilted_screw_crosses_stays_tilted_and_jams_high() -> None:
    end = outcome(tilt=0.055)
    assert (end.thread.crossed, end.thread.scarred) == (True, True)
    assert end.tilt > 3.0
    assert end.torque > 0.28
    assert end.height > 0.004


def taken(tilt: float) -> ThreadBench:
    """A bench on which a leaning screw has just been taken by its thread."""
    bench = ThreadBench(tilt=tilt)
    bench.drive_until(lambda: bench.thread.screw is not None, speed=SPEED, press=6.0, seconds=4.0)
    assert bench.thread.screw is not None
    return bench


def test_a_thread_takes_a_screw_where_it_is() -> None:
    bench = ThreadBench(tilt=0.045)
    before = bench.screw
    while bench.thread.screw is None:
        before = bench.screw
        bench.tick(SPEED, 6.0)
    middle = (0.0, 0.0, LENGTH + HEAD / 2, 1.0)
    assert (
        np.linalg.norm((bench.screw - before) @ middle) < 3e-4
    )  # m: no more than it turns and sinks in a tick


def test_a_thread_draws_a_leaning_screw_straight_within_a_turn() -> None:
    bench = taken(0.045)
    lean = bench.tilt
    assert lean > 1.0
    for _ in range(round(2 * pi / SPEED / JIFFY)):
        bench.tick(SPEED, 6.0)
    assert bench.tilt < 0.05 * lean


def test_a_crossed_screw_can_be_backed_out_and_leaves_a_scar() -> None:
    bench = taken(0.055)
    bench.drive_until(lambda: bench.driver.torque() > STOP, speed=SPEED, press=6.0, seconds=2.0)
    bench.drive_until(lambda: bench.thread.screw is None, speed=-SPEED, press=2.0, seconds=4.0)
    assert (bench.thread.screw, bench.thread.crossed, bench.thread.scarred) == (None, False, True)
    depth = MOUTH - bench.screw[2, 3]
    assert 0.0 < depth < 0.0014  # m: where its thread began


def test_the_motor_turns_no_screw_beside_or_over_which_the_bit_stands() -> None:
    bench = taken(0.0)
    bench.data.qpos[bench.model.joint("press").qposadr[0]] += 0.0005
    mujoco.mj_forward(bench.model, bench.data)
    bench.threads.before(JIFFY)
    assert bench.model.actuator_gainprm[bench.model.actuator("drive").id, 0] == 0.0


@pytest.mark.slow
def test_a_screw_seats_the_same_to_the_last_bit_every_time() -> None:
    assert drive_screw(tilt=0.02) == drive_screw(tilt=0.02)


@pytest.mark.parametrize(
    ("was", "instead", "told"),
    [
        (
            'geom name="bit"',
            'geom name="tip"',
            "^screw threads cannot work in this scene: Invalid name 'bit'",
        ),
        ("carrier0", "carrying", "^all tapped holes of a scene must be in one body, not in 0$"),
        (
            'joint2="thread_turn0"',
            'joint2="spindle"',
            "^no constraint of the scene couples thread_slide0 to thread_turn0$",
        ),
    ],
)
def test_what_threads_lack_in_a_scene_is_told(was: str, instead: str, told: str) -> None:
    model = mujoco.MjModel.from_xml_string(scene(0.0, 0.0).replace(was, instead))
    with pytest.raises(BadArgument, match=told):
        Threads(model, mujoco.MjData(model), ThreadBench().driver, ThreadFigures(phases=(1.0,)))


def test_every_hole_has_a_phase() -> None:
    bench = ThreadBench()
    with pytest.raises(BadArgument, match=r"^the scene has 1 tapped hole, not 2$"):
        Threads(bench.model, bench.data, bench.driver, ThreadFigures(phases=(1.0, 2.0)))


class ScrewingMachine:
    """A spindle on one axis, which presses with its weight and 1 N, and is switched by an output."""

    def __init__(self) -> None:
        spec = mujoco.MjSpec.from_string(scene(0.0, 0.0))
        servo = spec.add_actuator(name="press", target="press", trntype=mujoco.mjtTrn.mjTRN_JOINT)
        servo.set_to_position(kp=2000.0, kv=100.0)
        self.bench = bench = Bench(spec.compile())
        self.driver = SimulatedScrewdriver(
            bench.model, bench.data, ("drive", "spindle"), torque_noise=0.0, noise=np.random.default_rng(0),
            watchdog=Watchdog(JIFFY),
        )  # fmt: skip
        axis = AxisSpec(name="press", kind="prismatic", lower=-0.05, upper=0.05, speed=0.1, force=1.0)
        torque = {Channel(name="torque", unit="N m"): lambda _, __: (self.driver.torque(),)}
        self.axes = BenchAxes(bench, [axis], period=JIFFY, name="press", channels=torque)
        self.outputs = BenchOutputs(bench, "tools", {"spindle": self.driver.drive})
        self.threads = Threads(bench.model, bench.data, self.driver, ThreadFigures(phases=(1.0,)))
        bench.add(self.driver)
        bench.add(self.threads)

    def screw(self, periods: int) -> float:
        """Press and turn until the motor has to work too hard; its torque then."""
        self.outputs.set("spindle", SPEED)
        for _ in range(periods):
            self.axes.put(np.array([-0.05]))
            self.bench.advance(JIFFY)
            if (torque := self.axes.read().channels["torque"]) > STOP:
                return torque
        return 0.0


@pytest.mark.slow
def test_a_machine_of_a_bench_drives_a_screw_and_one_that_goes_on_from_a_state_drives_it_the_same() -> None:
    begun, resumed = ScrewingMachine(), ScrewingMachine()
    begun.screw(60)
    state = begun.bench.cell().capture()
    begun.bench.cell().restore(state)
    resumed.bench.cell().restore(state)
    assert STOP < begun.screw(300) == resumed.screw(300)
    assert 200 < begun.threads.holes[0].clamp < 300
    assert begun.bench.data.qpos.tobytes() == resumed.bench.data.qpos.tobytes()
