"""The Purbrick arm: the scene is what its machine's manual says, and a bench keeps time and places."""

import mujoco
import numpy as np
import pytest

from handeye.cell.bench import Bench
from handeye.core.entries import Entry, _registered, register
from handeye.core.errors import InvalidInput
from handeye.machines import find_machine
from handeye.machines.purbrick import PURBRICK
from handeye.ports.axes import AxisSpec
from handeye.systems.trig.jobs.table import HEIGHT, NOMINAL, BlockTable, purbrick
from handeye.systems.trig.language.no_arm import BLOCK, TRAVEL
from handeye.systems.trig.language.place import Place


@pytest.fixture
def bench() -> Bench:
    return Bench(PURBRICK.scene().compile())


def test_a_system_offers_a_machine_by_its_name(monkeypatch: pytest.MonkeyPatch) -> None:
    place = "handeye.machines.purbrick:PURBRICK"
    with pytest.raises(InvalidInput, match=r"^there is no machine `crane`; the machines are "):
        find_machine("crane")
    monkeypatch.setitem(_registered, "yard", None)
    register(
        Entry(name="yard", title="the yard", help="Lifts.", system="yard:YARD", machines={"crane": place})
    )
    assert find_machine("crane") is find_machine("purbrick") is PURBRICK


@pytest.mark.parametrize("spec", PURBRICK.axes, ids=lambda spec: spec.name)
def test_the_scene_has_each_axis_as_the_machine_has_it(bench: Bench, spec: AxisSpec) -> None:
    joint = bench.model.joint(spec.name)
    kind = {"prismatic": mujoco.mjtJoint.mjJNT_SLIDE, "revolute": mujoco.mjtJoint.mjJNT_HINGE}[spec.kind]
    assert joint.type[0] == kind
    assert joint.range == pytest.approx([spec.lower, spec.upper], abs=1e-4)


def test_an_axis_moves_the_hand_over_the_platter() -> None:
    """By its own amount and in its own direction, and the tips touch the platter at zero."""
    model = PURBRICK.scene().compile()
    data = mujoco.MjData(model)

    def tip() -> np.ndarray:
        mujoco.mj_forward(model, data)
        middle = (data.geom("sensed_tip").xpos + data.geom("other_tip").xpos) / 2
        half = model.geom("sensed_tip").size[2]
        low: np.ndarray = middle - [0, 0, half] - data.body("platter").xpos
        return low

    assert tip() == pytest.approx([0, 0, 0], abs=1e-9)
    for axis in range(3):
        data.qpos[:] = 0
        data.joint(PURBRICK.axes[axis].name).qpos[0] = 0.1
        assert tip() == pytest.approx(np.eye(3)[axis] * 0.1, abs=1e-9)


def test_the_arm_that_is_imagined_has_the_travel_of_this_one() -> None:
    assert tuple((spec.lower, spec.upper) for spec in PURBRICK.axes) == TRAVEL


def test_a_stack_of_twenty_blocks_stands_what_the_platter_does() -> None:
    """It tips where its weight, at half its height, turns it over the edge of its base: planned, and measured."""
    tips_at = 9.81 * (BLOCK / 2) / (20 * HEIGHT / 2)
    arm, table = purbrick()
    measured: list[float] = []
    slides = [table.bench.data.joint(name) for name in "xy"]
    table.bench.before_step.append(lambda: measured.extend(abs(float(slide.qacc[0])) for slide in slides))
    arm.go(Place(x=0.05, y=0.03, z=0.3), lambda: False)
    assert PURBRICK.limits.acceleration[0] < max(measured) < tips_at == pytest.approx(1.226, abs=0.001)


def test_a_bench_keeps_time_in_whole_steps(bench: Bench) -> None:
    for _ in range(1000):
        bench.advance(0.001)
    assert bench.now == 1.0
    with pytest.raises(InvalidInput, match=r"is not a whole number of physics steps of 0\.001 s"):
        bench.advance(0.0015)


def test_the_axes_go_where_they_are_told(bench: Bench) -> None:
    axes = find_machine("purbrick").on_bench(bench)
    goal = np.array([0.01, -0.02, 0.1, 0.1, 0.0, -0.1, PURBRICK.limits.open])
    axes.put(goal)
    bench.advance(1.0)
    reading = axes.read()
    assert reading.q == pytest.approx(goal, abs=1e-4)
    assert (reading.time, axes.period) == (1.0, 0.01)
    with pytest.raises(InvalidInput, match=r"^a goal of an axis is not a finite number$"):
        axes.put(goal * np.nan)


def test_what_lies_on_the_platter_stays_there_when_more_is_put_there() -> None:
    table = BlockTable(NOMINAL)
    table.stack(2, 0.05, 0.0)
    table.bench.advance(0.2)
    before = table.poses
    table.stack(1, -0.05, 0.0)
    table.bucket(0.1, 0.1)
    after = table.poses
    assert all(after[name] == pytest.approx(at, abs=1e-6) for name, at in before.items())
    assert table.count == 3
    with pytest.raises(InvalidInput, match=r"^there is already a bucket"):
        table.bucket(0.1, -0.1)
    table.clear()
    assert (table.count, table.bench.now) == (0, 0.2)
    table.bucket(0.1, 0.1)


def test_an_arm_is_switched_on_above_the_middle_with_its_hand_open() -> None:
    arm, table = purbrick()
    assert arm.here().measures() == (0, 0, 300, 0, 0, 0)
    assert (arm.closed, table.count) == (False, 0)


@pytest.mark.parametrize("turn", [-0.02, 0.005, 0.02])
def test_a_block_that_lies_turned_between_the_fingers_is_grasped_without_a_blow(turn: float) -> None:
    arm, table = purbrick()
    table.stack(1, 0.0005, 0.001)
    data = table.bench.data
    data.joint("block_1").qpos[3:] = np.cos(turn / 2), 0, 0, np.sin(turn / 2)
    arm.go(Place(z=0.006), lambda: False)
    speeds: list[float] = []
    table.bench.before_step.append(lambda: speeds.append(float(np.abs(data.joint("block_1").qvel[:3]).max())))
    arm.hand(closed=True)
    assert max(speeds) < 1.0
    assert arm.gap == pytest.approx(0.030, abs=3e-4)
    assert table.poses["block_1"][:2, 3] == pytest.approx((0.0005, 0.0), abs=5e-4)  # centred along Y
