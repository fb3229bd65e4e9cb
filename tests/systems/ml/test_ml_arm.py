"""The rectilinear arm with physics: the figures of the paper, the gripper, and what the sensors feel in the air."""

from collections.abc import Callable
from typing import Final

import mujoco
import numpy as np
import pytest
from station_bench import NAMES, UNIT, Arm

from handeye.core.mutable_records import copied
from handeye.systems.ml.bench.arm import AXES, PROBE, SIGNALS
from handeye.systems.ml.bench.station import scene
from handeye.systems.ml.bench.world import ArmWorld
from handeye.systems.ml.language.lint import FINGERS_KG, STIFFNESS
from handeye.systems.ml.realtime.happenings import GoalRounded

SERVO: Final = 2 * np.pi * 50  # rad/s
_PEAK: Final = 0.2  # m/s


def block(size: float, at: tuple[float, float], high: float) -> Callable[[mujoco.MjSpec], None]:
    """Adds a steel block that stands on the table, m."""

    def add(spec: mujoco.MjSpec) -> None:
        body = spec.worldbody.add_body(name="block", pos=[*at, high / 2])
        body.add_freejoint(name="block")
        body.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[size / 2, size / 2, high / 2], density=7800)

    return add


def test_the_scene_has_the_travel_and_the_servos_of_the_specification() -> None:
    model = scene(ArmWorld()).compile()
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    inertia = np.zeros((model.nv, model.nv))
    mujoco.mj_fullM(model, data, inertia)
    for axis in AXES:
        servo = model.actuator(axis.name)
        stiffness, damping = servo.gainprm[0], -servo.biasprm[2]
        if axis.name in NAMES.values():
            joint = model.joint(axis.name)
            assert joint.range[0] <= axis.lower < axis.upper <= joint.range[1]
            mass = inertia[joint.dofadr[0], joint.dofadr[0]]
            if axis.name != "base":  # whose inertia depends on the slides
                assert np.sqrt(stiffness / mass) == pytest.approx(SERVO, rel=0.01)
                assert (damping + joint.damping[0]) / mass == pytest.approx(1.6 * SERVO, rel=0.01)


@pytest.mark.ml_row(10)
def test_a_slide_goes_two_inches_at_no_more_than_20_cm_a_second() -> None:
    arm, fastest = Arm(), [0.0]
    arm.station.bench.after_step.append(lambda: fastest.append(abs(float(arm.data.joint("y").qvel[0]))))
    began = arm.level.now
    assert arm.go(m3=2000) == "goal"
    assert arm.truth(3) == pytest.approx(2000, abs=6)
    assert 0.25 <= (arm.level.now - began) / 100 <= 0.31
    assert max(fastest) == pytest.approx(_PEAK, rel=0.04)  # its set-point does not, and the servo overshoots


@pytest.mark.ml_row(11)
@pytest.mark.ml_row(12)
@pytest.mark.ml_row(13)
def test_rotations_and_increments_end_where_they_are_asked_to_and_the_base_at_its_detents() -> None:
    arm = Arm()
    arm.go(m9=4000, m2=500)
    assert arm.truth(9) == pytest.approx(4000, abs=6)
    for _ in range(2):
        arm.go(m2=arm.level.goal(2) - 100)
    assert arm.truth(2) == pytest.approx(300, abs=6)
    for asked, detent in ((330, 250), (380, 500)):
        arm.go(m1=asked)
        assert arm.truth(1) == pytest.approx(detent, abs=6)
    assert [e.goal for e in arm.events if isinstance(e, GoalRounded)] == [250, 500]


def test_a_slide_stops_anew_within_the_repeatability_of_the_paper_and_its_reading_agrees() -> None:
    arm, off = Arm(3), list[float]()
    for number in range(16):
        arm.go(m4=2000 * (number % 2))
        arm.cycles(5)
        assert abs(arm.level.position(4) - 2000 * (number % 2)) <= 6
        off.append(arm.truth(4) - arm.level.position(4))
    at = np.array(off).reshape(-1, 2)  # the potentiometer bends differently at the two places
    spread = np.ptp(at, axis=0)
    assert (spread <= 0.38e-3 / UNIT + 3).all()
    assert (spread > 0.15e-3 / UNIT).all()
    assert len(np.unique(np.round(off, 1))) > 8


def test_an_arm_that_is_restored_in_mid_motion_goes_on_to_the_same_places() -> None:
    ends = []
    for astray in (False, True):
        arm = Arm(5)
        arm.level.start({3: 1500, 4: -700})
        arm.cycles(12)
        cell = arm.station.cell()
        state, memory = cell.capture(), copied(arm.machine.memory)
        if astray:
            arm.go(m3=-3000, m2=800)
        cell.restore(state)
        arm.machine.remember(memory)
        assert arm.go(m3=1500) == "goal"
        ends.append(arm.data.qpos.copy())
    assert (ends[0] == ends[1]).all()


@pytest.mark.ml_row(56)
def test_without_its_pump_the_arm_is_relaxed_and_does_not_sink() -> None:
    arm = Arm(at={8: 3000, 9: 2000})
    arm.level.disable()
    before, wrist = arm.tip(), [arm.truth(motor) for motor in (8, 9)]
    arm.cycles(100)
    assert np.abs(arm.tip() - before).max() < 1e-5
    arm.data.xfrc_applied[arm.station.bench.model.body("hand").id, :4] = (
        20,
        0,
        0,
        2,
    )  # N and N m, by a person
    arm.cycles(50)
    assert arm.tip()[0] > before[0] + 0.02
    assert abs(arm.truth(9) - wrist[1]) < 30  # yaw is electric


@pytest.mark.ml_row(56)
def test_without_the_pump_the_hand_does_not_drop_what_it_holds() -> None:
    arm = Arm(add=block(0.02, (0, 0), 0.05), at={2: 8000, 11: 1600}, wand=False)
    arm.level.write("MT", 11, 9, 4000)  # the tolerance of motor 11: a part keeps it from its goal
    arm.go(m11=0)
    arm.cycles(30)
    arm.go(m2=4000)
    arm.level.disable()
    arm.cycles(100)
    held = arm.data.body("block").xpos - arm.tip()
    assert np.linalg.norm(held) < 0.03
    assert arm.data.body("block").xpos[2] > 0.1  # the part pulls the arm down by 5 mm a second


def test_a_freeze_costs_the_hand_a_part_of_its_grip() -> None:
    """A freeze makes the present positions the goals, those of the fingers too."""
    arm = Arm(add=block(0.02, (0, 0), 0.05), at={2: 8000, 11: 1600}, wand=False)
    arm.level.write("MT", 11, 9, 4000)
    arm.go(m11=0)
    arm.cycles(30)

    def grip() -> float:
        return 100_000 * abs(float(arm.data.joint("left_x").qpos[0]))

    assert grip() == pytest.approx(90, rel=0.05)
    arm.level.expect(8, 0, 1)  # the range is not within these limits
    arm.cycles(20)
    assert 45 < grip() < 75
    arm.level.open()
    arm.go(m11=0)
    arm.cycles(20)
    assert grip() == pytest.approx(90, rel=0.05)


def test_the_angle_of_the_fingers_locks_itself() -> None:
    """Stiffer than 1000 N m/rad: a screwdriver does not swing between the fingers."""
    arm = Arm()
    for finger, sense in (("left_knuckle", 1.0), ("right_knuckle", 1.0)):  # both to one side
        arm.data.xfrc_applied[arm.station.bench.model.body(finger).id, 4] = 2.0 * sense
    arm.cycles(30)
    assert abs(float(arm.data.joint("left_angle").qpos[0])) < 2.0 / 1000
    assert abs(float(arm.data.joint("right_angle").qpos[0])) < 2.0 / 1000


@pytest.mark.parametrize("speed", [10, 40, 79])
def test_a_sudden_start_is_felt_as_speed_times_the_root_of_stiffness_and_mass(speed: int) -> None:
    """The law of false trips: speed v that begins at once, stiffness k and mass m give a force of v sqrt(k m)."""
    arm, felt, bent = Arm(), [0.0], [0.0]
    model = arm.station.bench.model

    def look() -> None:
        felt.append(abs(float(arm.data.joint("left_z").qpos[0])))
        bent.append(PROBE * float(np.hypot(*(arm.data.joint(f"wand_{axis}").qpos[0] for axis in "xy"))))

    arm.station.bench.after_step.append(look)
    for motor in (2, 4):
        arm.level.write("MT", motor, 8, speed)
    arm.go(m2=800)
    arm.go(m4=800)
    v = min(speed * UNIT * 100, _PEAK)
    stiffness = float(model.joint("left_z").stiffness[0])
    law = v * np.sqrt(stiffness * float(model.body("left").mass[0]))
    assert 0.3 * law < stiffness * max(felt) < law
    probe = model.body("wand")
    inertia = float(probe.inertia[0] + probe.mass[0] * probe.ipos[2] ** 2 + model.joint("wand_x").armature[0])
    lever = float(-probe.mass[0] * probe.ipos[2])
    jump = PROBE * v * lever / np.sqrt(inertia * float(model.joint("wand_x").stiffness[0]))
    assert 0.2 * jump < max(bent) < jump
    assert jump < SIGNALS  # so that the wand does not signal in the air at any speed of the arm


def test_the_range_finder_shows_the_nearest_object_in_its_cone() -> None:
    arm = Arm(add=block(0.04, (0, -0.024), 0.06), at={2: 2000})
    arm.cycles(5)
    below = 0.25 - 2000 * UNIT + 0.086  # m from its eye to the table
    assert arm.level.reading(8) == pytest.approx((below - 0.06) / 1e-4, abs=30)
    arm.go(m4=6000)
    arm.cycles(5)
    assert arm.level.reading(8) == pytest.approx(below / 1e-4, abs=60)


def post(spec: mujoco.MjSpec) -> None:
    """A post of 50 cm beside the table, where the cross rail passes."""
    spec.worldbody.add_geom(type=mujoco.mjtGeom.mjGEOM_BOX, size=[0.01, 0.01, 0.25], pos=[0.25, 0.035, 0.25])


@pytest.mark.ml_row(51)
@pytest.mark.slow
def test_with_another_angle_of_the_base_the_hand_comes_to_the_same_pose_past_a_post() -> None:
    """The nine motors leave a choice: the base and the slides together, or the slides alone."""
    poses = []
    for goals in ({1: 0, 3: 0, 4: -3000, 8: 0}, {1: 2500, 3: -1314, 4: 8928, 8: -2500}):
        arm = Arm(add=post, at={2: -9000})
        arm.go(**{f"m{motor}": goal for motor, goal in goals.items()})
        assert arm.truth(2) == pytest.approx(-9000, abs=6)
        ended = arm.go(m2=5000)
        poses.append((ended, arm.data.body("hand").xmat.copy(), arm.tip()))
    assert [ended for ended, _, _ in poses] == ["emergency", "goal"]  # the rail stands on the post
    assert poses[1][2] == pytest.approx([-3000 * UNIT, 0, 0.25 - 5000 * UNIT], abs=2e-4)
    assert poses[1][1] == pytest.approx(np.eye(3).ravel(), abs=1e-3)


def test_the_slides_have_force_to_spare_in_free_air() -> None:
    arm, most = Arm(), {"z": 0.0, "y": 0.0, "x": 0.0}

    def look() -> None:
        for name in most:
            most[name] = max(most[name], abs(float(arm.data.actuator(name).force[0])))

    arm.station.bench.after_step.append(look)
    arm.level.start({2: 1000, 3: 1000, 4: 1000})
    arm.cycles(8)
    arm.level.expect(8, 0, 1)  # a freeze at full speed
    arm.cycles(20)
    limits = {axis.name: axis.force for axis in AXES}
    assert all(force < (limits[name] or 0) * 2 / 3 for name, force in most.items()), most


def test_the_checker_computes_jolts_with_the_stiffness_and_the_mass_of_the_simulated_fingers() -> None:
    model = Arm(wand=False).station.bench.model
    for side in ("left", "right"):
        assert [float(model.joint(f"{side}_{axis}").stiffness[0]) for axis in "yz"] == [STIFFNESS] * 2
        assert float(model.body(side).mass[0]) == FINGERS_KG


def test_along_the_line_between_the_fingers_the_stiffer_gauges_feel_a_smaller_jolt_than_the_checker_expects() -> (
    None
):
    arm, felt = Arm(wand=False), 0.0
    zero = arm.station.arm.read().channels["left_strain_x"]
    arm.level.start({4: 1500})
    while not arm.level.posted:
        arm.machine.cycle()
        felt = max(felt, abs(arm.station.arm.read().channels["left_strain_x"] - zero))
    assert 0.5 < felt < 0.5 * _PEAK * np.sqrt(STIFFNESS * FINGERS_KG)
