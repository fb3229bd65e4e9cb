"""Long steps of physics while nothing touches but what is carried, and middle or short ones for contact."""

import mujoco
import numpy as np
import pytest

from handeye.cell.physics_stepper import FINER, LONGER, MIDDLE, Carrying, PhysicsStepper, stiffened
from handeye.core.pose import Array

SHORT = 1 / 960
PERIOD = 16
BALL = """<mujoco><option timestep="{short}"/><worldbody><geom type="plane" size="1 1 .1"/>
<body pos="0 0 .2"><freejoint/><geom type="sphere" size=".05" solref="-400000 0" priority="1"/></body>
</worldbody></mujoco>"""


class Falling:
    """A ball 150 mm over the floor, let go; it bounces back within 5 ms."""

    def __init__(self) -> None:
        self.model = mujoco.MjModel.from_xml_string(BALL.format(short=SHORT))
        self.data = mujoco.MjData(self.model)
        mujoco.mj_forward(self.model, self.data)
        self.stepper = PhysicsStepper(self.model, self.data)

    def fall(self, periods: int, *, short: bool = False) -> Array:
        """Let time pass; heights of the ball (m) behind each servo period."""
        heights = []
        for _ in range(periods):
            if short:
                mujoco.mj_step(self.model, self.data, PERIOD)
            else:
                self.stepper.step(PERIOD)
            heights.append(self.data.qpos[2])
        return np.array(heights)


@pytest.fixture
def steps(monkeypatch: pytest.MonkeyPatch) -> list[float]:
    """Lengths (s) of the steps that are made, those taken back as well."""
    made: list[float] = []
    step = mujoco.mj_step

    def counted(model: mujoco.MjModel, data: mujoco.MjData, number: int = 1) -> None:
        made.extend([model.opt.timestep] * number)
        step(model, data, number)

    monkeypatch.setattr(mujoco, "mj_step", counted)
    return made


def test_what_falls_freely_falls_in_long_steps_for_as_long(steps: list[float]) -> None:
    ball = Falling()
    ball.fall(5)
    assert steps == [LONGER * SHORT] * (5 * PERIOD // LONGER)
    assert ball.data.time == pytest.approx(5 * PERIOD * SHORT)


def test_a_free_motion_is_early_by_half_the_difference_of_the_steps() -> None:
    long, short = Falling().fall(8), Falling().fall(8, short=True)
    speed = 9.81 * 8 * PERIOD * SHORT
    assert short[-1] - long[-1] == pytest.approx(speed * (LONGER - 1) * SHORT / 2, rel=1e-6)


def test_no_contact_feels_a_long_step(steps: list[float]) -> None:
    """The ball meets the floor in the eleventh period and leaves it: from its beginning on all steps are short."""
    ball, like = Falling(), Falling()
    ball.fall(10)
    assert max(steps) == LONGER * SHORT
    like.data.qpos[:], like.data.qvel[:] = ball.data.qpos, ball.data.qvel
    mujoco.mj_forward(like.model, like.data)
    assert ball.fall(1) == like.fall(1, short=True)
    assert ball.data.qvel[2] > 1.0


def test_what_touches_when_a_period_ends_has_come_there_in_short_steps(steps: list[float]) -> None:
    """A long step may end in a contact that it has not felt yet: it is taken back, too."""
    for height in np.linspace(0.06, 0.2, 57):
        ball = Falling()
        ball.data.qpos[2] = height
        while ball.data.qpos[2] >= 0.05 and ball.data.qvel[2] <= 0.0:
            ball.fall(1)
        assert steps[-PERIOD:] == [SHORT] * PERIOD


def test_the_step_of_the_model_is_the_short_one_for_who_looks_on() -> None:
    ball = Falling()
    ball.fall(3)
    assert ball.model.opt.timestep == SHORT


TRAY = """<mujoco><option timestep="{short}" integrator="implicitfast"/><worldbody>
<body name="tray" gravcomp="1"><joint name="up" type="slide" axis="0 0 1"/>
<geom type="box" size=".1 .1 .01" {soft}/></body>
<body name="ball" pos="0 0 .0599995"><freejoint/><geom size=".05" mass=".5" {soft}/></body>
<geom type="box" size=".1 .01 .01" pos="0 0 {bar}"/>
</worldbody><actuator><velocity joint="up" kv="100000"/></actuator></mujoco>"""
RISING = 0.05  # m/s
SOFT = f'solref="{2 * SHORT} 1" solimp=".99 .99 .001"'  # the stiffest that short steps allow


class Lift:
    """A tray that rises with a ball on it, beneath a bar."""

    def __init__(
        self, *, carries: bool = True, bar: float = 1.0, delicate: tuple[tuple[str, ...], ...] | None = None
    ) -> None:
        self.model = mujoco.MjModel.from_xml_string(TRAY.format(short=SHORT, bar=bar, soft=SOFT))
        self.data = mujoco.MjData(self.model)
        self.data.ctrl[0], self.data.qvel[[0, 3]] = RISING, RISING
        pairs = (("tray", "ball"),) if carries else ()
        self.stepper = PhysicsStepper(
            self.model, self.data, Carrying(hand="tray", pairs=pairs, delicate=delicate)
        )
        mujoco.mj_forward(self.model, self.data)

    def rise(self, periods: int) -> "Lift":
        for _ in range(periods):
            self.stepper.step(PERIOD)
        return self

    @property
    def sunk(self) -> float:
        """Depth of the ball in the tray, m."""
        return float(0.06 - (self.data.qpos[3] - self.data.qpos[0]))


def test_what_is_carried_through_the_air_takes_long_steps_and_what_is_not_carried_short_ones(
    steps: list[float],
) -> None:
    Lift().rise(4)
    assert steps == [LONGER * SHORT] * (4 * PERIOD // LONGER)
    steps.clear()
    Lift(carries=False).rise(4)
    assert steps == [SHORT] * (4 * PERIOD)


def test_a_load_sinks_as_deep_in_steps_of_every_length(steps: list[float]) -> None:
    """Over a step four times as long a contact would be sixteen times as soft."""
    short = Lift(carries=False).rise(60)
    for lift, times in ((Lift(delicate=()), LONGER), (Lift(carries=False, delicate=()), MIDDLE)):
        steps.clear()
        lift.rise(60)
        assert set(steps) == {times * SHORT}
        assert lift.sunk == pytest.approx(short.sunk, rel=0.002)
        assert lift.model.geom_solimp.tobytes() == short.model.geom_solimp.tobytes()


def test_a_contact_has_the_same_force_on_either_side_of_a_change_of_step() -> None:
    lift = Lift(carries=False, delicate=()).rise(60)
    force, forces = np.zeros(6), []
    for _ in range(3):
        mujoco.mj_step(lift.model, lift.data, PERIOD)
        mujoco.mj_contactForce(lift.model, lift.data, 0, force)
        forces.append(force[0])
        lift.rise(1)
        mujoco.mj_contactForce(lift.model, lift.data, 0, force)
        forces.append(force[0])
    assert forces == pytest.approx([0.5 * 9.81] * 6, rel=0.002)


def test_a_weld_gives_way_as_far_in_middle_steps_as_in_short_ones() -> None:
    deep = []
    for delicate in ((), None):
        model = mujoco.MjModel.from_xml_string(HUNG.format(short=SHORT, soft=SOFT))
        data = mujoco.MjData(model)
        mujoco.mj_forward(model, data)
        stepper = PhysicsStepper(model, data, Carrying(hand="tray", pairs=(), delicate=delicate))
        for _ in range(60):
            stepper.step(PERIOD)
        deep.append(data.qpos[2] - 0.5)
    assert deep[1] < -1e-6
    assert deep[0] == pytest.approx(deep[1], rel=0.01)


def test_stiffness_is_kept_exactly_at_the_surface_and_at_full_depth() -> None:
    """Stiffness: d**2 / (D**2 * T**2 * (1 - d)), of a time constant T of at least two steps."""
    soft = np.array([[0.95, 0.99, 0.0005, 0.5, 2.0]])
    for constant in (2 * SHORT, 0.003, 0.02):
        stiff = stiffened(soft, np.array([constant]), SHORT, LONGER)
        for d, e in zip(soft[0, :2], stiff[0, :2], strict=True):
            short, long = (
                x**2 / (most**2 * max(constant, 2 * step) ** 2 * (1 - x))
                for x, most, step in ((d, soft[0, 1], SHORT), (e, stiff[0, 1], LONGER * SHORT))
            )
            assert long == pytest.approx(short, rel=1e-9)
        assert stiff[0, 2:].tolist() == soft[0, 2:].tolist()


def test_a_stiffness_that_does_not_depend_on_the_step_is_left_alone() -> None:
    soft = np.array([[0.95, 0.99, 0.0005, 0.5, 2.0]])
    assert stiffened(soft, np.array([-1000.0]), SHORT, LONGER).tolist() == pytest.approx(soft)


def loses_its_contact_in_short_steps(lift: Lift, like: Lift, steps: list[float]) -> None:
    """Draw the tray away: the period in which the ball loses it is as if all its steps had been short."""
    for each in (lift, like):
        each.data.ctrl[0] = -2.0 * RISING
    steps.clear()
    lift.rise(1)
    assert steps[-PERIOD:] == [SHORT] * PERIOD
    mujoco.mj_step(like.model, like.data, PERIOD)
    assert lift.data.qpos.tobytes() == like.data.qpos.tobytes()


def test_a_load_that_loses_its_contact_does_so_in_short_steps(steps: list[float]) -> None:
    """The tray is drawn away from beneath the ball."""
    loses_its_contact_in_short_steps(Lift().rise(4), Lift().rise(4), steps)


def test_a_load_that_meets_something_else_does_so_in_short_steps(steps: list[float]) -> None:
    """The ball rises 20 mm to the bar: from the period in which it meets it, all is as if all steps had been short."""
    clear = 0.02
    lift, like = (Lift(bar=0.06 + 0.05 + 0.01 + clear) for _ in range(2))
    while not lift.data.time > 0.0 or steps[-1] > SHORT:
        like.data.qpos[:], like.data.qvel[:] = lift.data.qpos, lift.data.qvel
        like.data.qacc_warmstart[:] = lift.data.qacc_warmstart
        lift.rise(1)
    assert lift.data.time == pytest.approx(clear / RISING, abs=2 * PERIOD * SHORT)
    mujoco.mj_step(like.model, like.data, PERIOD)
    assert lift.data.qpos.tobytes() == like.data.qpos.tobytes()


HUNG = """<mujoco><option timestep="{short}" integrator="implicitfast"/><worldbody>
<body name="hung" pos="0 0 .5"><freejoint/><geom size=".05" mass="5"/></body>
<body name="tray"><joint type="slide" axis="1 0 0"/><geom type="box" size=".1 .1 .01" {soft}/></body>
<body pos="0 0 .059"><freejoint/><geom size=".05" mass=".5" {soft}/></body>
</worldbody><equality><weld body1="hung" solref=".004 1" solimp=".99 .999 .0001"/></equality></mujoco>"""


@pytest.mark.parametrize("delicate", [(("ball",),), (("tray", "ball"),)])
def test_a_delicate_contact_takes_short_steps(
    delicate: tuple[tuple[str, ...], ...], steps: list[float]
) -> None:
    Lift(carries=False, delicate=delicate).rise(2)
    assert steps == [SHORT] * (2 * PERIOD)


def test_the_hand_gains_and_loses_contacts_in_short_steps_only(steps: list[float]) -> None:
    """The tray is drawn away from beneath the ball, which falls back on it."""
    lift, like = (Lift(carries=False, delicate=()).rise(4) for _ in range(2))
    loses_its_contact_in_short_steps(lift, like, steps)


def test_contacts_of_other_bodies_begin_in_middle_steps(steps: list[float]) -> None:
    """The ball meets the bar; the tray holds both of its contacts as they are."""
    lift = Lift(carries=False, bar=0.06 + 0.05 + 0.01 + 0.002, delicate=())
    while lift.data.ncon < 2:
        lift.rise(1)
    assert set(steps) == {MIDDLE * SHORT}


CAROUSEL = """<mujoco><option timestep="{short}" integrator="implicitfast" cone="elliptic" impratio="50"/><worldbody>
<body name="tray"><joint name="round" axis="0 0 1"/><geom type="box" size=".1 .1 .01" pos=".5 0 0" {soft}/></body>
<body name="box" pos=".5 0 .0299999"><freejoint/>
<geom type="box" size=".02 .02 .02" friction="{grip}" priority="1" {soft}/></body>
</worldbody><actuator><velocity joint="round" kv="100000"/></actuator></mujoco>"""


def slipped(*, carries: bool, grip: float = 1.0, periods: int = 120) -> tuple[float, float]:
    """How far (m) and by what angle (rad) a box slips on a tray that carries it along an arc at 1 rad/s; `grip` is the
    coefficient of friction.
    """
    model = mujoco.MjModel.from_xml_string(CAROUSEL.format(short=SHORT, soft=SOFT, grip=grip))
    data = mujoco.MjData(model)
    data.ctrl[0] = data.qvel[0] = data.qvel[6] = 1.0  # rad/s
    data.qvel[2] = 0.5  # m/s
    carrying = Carrying(hand="tray", pairs=(("tray", "box"),)) if carries else None
    stepper = PhysicsStepper(model, data, carrying)
    mujoco.mj_forward(model, data)
    for _ in range(periods):
        stepper.step(PERIOD)
    mujoco.mj_kinematics(model, data)
    R = data.body("tray").xmat.reshape(3, 3).T @ data.body("box").xmat.reshape(3, 3)
    at = data.body("tray").xmat.reshape(3, 3).T @ data.body("box").xpos
    return float(np.hypot(*(at - (0.5, 0.0, 0.03))[:2])), float(np.arctan2(R[1, 0], R[0, 0]))


def test_what_the_hand_carries_along_an_arc_is_not_left_behind() -> None:
    """In short steps it is, by half a step times the acceleration of the arc, .5 m/s2, for 2 s: .52 mm."""
    short, long = slipped(carries=False), slipped(carries=True)
    assert short[0] == pytest.approx(0.5 * SHORT * 0.5 * 2.0, rel=0.1)
    assert long[0] < short[0] / 10
    assert abs(long[1]) < 1e-4


def test_a_load_that_friction_does_not_hold_slips_off_as_in_short_steps() -> None:
    """The arc takes .5 m/s2 of friction, a coefficient of .051; with .03 the box slides outwards."""
    short, long = (slipped(carries=carries, grip=0.03, periods=30)[0] for carries in (False, True))
    assert short > 0.02
    assert long == pytest.approx(short, rel=0.05)


SPRING = """<mujoco><option timestep="{short}"/><worldbody><body>
<joint name="spring" type="slide" axis="0 0 1" stiffness="1.6e7"/><geom size=".05" mass="1"/></body></worldbody>
<actuator><motor joint="spring"/></actuator></mujoco>"""
"""A spring that swings with 640 Hz: too fast for long or short steps, but not for fine ones."""


def test_what_diverges_is_computed_again_in_fine_steps(steps: list[float]) -> None:
    model = mujoco.MjModel.from_xml_string(SPRING.format(short=SHORT))
    data = mujoco.MjData(model)
    data.qpos[0], data.ctrl[0] = 1e-4, 2.0
    stepper = PhysicsStepper(model, data)
    mujoco.mj_forward(model, data)
    stepper.step(PERIOD)
    assert steps == [LONGER * SHORT] * (PERIOD // LONGER) + [SHORT / FINER] * (PERIOD * FINER)
    assert data.time == pytest.approx(PERIOD * SHORT)
    assert abs(data.qpos[0]) < 2e-4
    assert data.ctrl[0] == 2.0
    assert not data.warning.number.any()
