"""Long steps of physics while nothing touches, and short ones for contact."""

import mujoco
import numpy as np
import pytest

from handeye.cell.physics_stepper import LONGER, PhysicsStepper
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
