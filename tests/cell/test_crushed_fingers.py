"""A finger that overloaded friction lifts off in a corner of a hole is not thrown about in short steps of physics."""

import mujoco
import numpy as np
import pytest

from handeye.cell.physics_stepper import CRUSHING, FINER, PhysicsStepper

SHORT, PERIOD = 1 / 960, 16
GRIP = 80.0  # N
WEDGES, RADIUS, THICK = 24, 0.015875, 0.006  # of the hole: as of large hole 2 of the base; m
ASIDE, TURNED, OFF = 0.0025, np.radians(2.0), 1e-4  # m, rad, m: farthest starts
STARTS = 50
SMALL = GRIP * OFF  # J, the work of the motor until the first touch at most
PAD = 'solref=".00208333 1" solimp=".99 .999 .0001" friction="1" condim="4"'
WEDGE = '<geom type="box" size="{t} {half} .0127" pos="{x} {y} 0" euler="0 0 {turn}" contype="2" {pad}/>'
FINGER = """<mujoco><option timestep="{short}" integrator="implicitfast" cone="elliptic" impratio="50" gravity="0 0 0"
ccd_tolerance="1e-12"/><worldbody>
<body name="part"><joint name="aside" type="slide" axis="1 0 0"/><joint name="turn"/>
<inertial pos="0 0 0" mass="2.6" diaginertia=".004 .006 .0093"/>{wedges}</body>
<body name="finger"><joint name="finger" type="slide" axis="0 -1 0"/>
<geom type="box" size=".009525 .00127 .0127" mass=".24" contype="1" conaffinity="2" {pad}/>
<site name="pad" type="box" size=".0115 .0035 .0145"/></body>
</worldbody><actuator><motor joint="finger"/></actuator><sensor><touch site="pad"/></sensor></mujoco>"""


class Hole:
    """A finger in a hole of a part that is made of wedges. The part can slip aside and turn."""

    def __init__(self) -> None:
        turns = 2 * np.pi * np.arange(WEDGES) / WEDGES
        wedges = "".join(
            WEDGE.format(
                t=THICK, half=RADIUS * np.tan(np.pi / WEDGES), turn=np.degrees(turn), pad=PAD,
                x=(RADIUS + THICK) * np.cos(turn), y=(RADIUS + THICK) * np.sin(turn),
            )
            for turn in turns
        )  # fmt: skip
        self.model = mujoco.MjModel.from_xml_string(FINGER.format(short=SHORT, pad=PAD, wedges=wedges))
        self.data = mujoco.MjData(self.model)
        self.stepper = PhysicsStepper(self.model, self.data)

    def gain(self, aside: float, turn: float, off: float) -> float:
        """Press with the finger for one servo period, from `off` (m) before its first touch. Returns the energy (J) of
        finger and part less the work of the finger's motor.
        """
        mujoco.mj_resetData(self.model, self.data)
        self.data.qpos[:2] = aside, turn
        start = self._touch() - off
        self.data.qpos[2], self.data.ctrl[0] = start, GRIP
        mujoco.mj_forward(self.model, self.data)
        self.stepper.step(PERIOD)
        work = GRIP * (self.data.qpos[2] - start)
        mujoco.mj_energyVel(self.model, self.data)  # kinetic
        return float(self.data.energy[1] - work)

    def _touch(self) -> float:
        """The position (m) of the finger at its first touch."""
        free, deep = 0.0, RADIUS
        for _ in range(30):
            self.data.qpos[2] = middle = (free + deep) / 2
            mujoco.mj_fwdPosition(self.model, self.data)
            free, deep = (free, middle) if self.data.ncon else (middle, deep)
        return free


def gains() -> list[float]:
    """What the energy gains (J) from several starts."""
    hole, random = Hole(), np.random.default_rng(0)
    starts = random.uniform((-ASIDE, -TURNED, 0.0), (ASIDE, TURNED, OFF), (STARTS, 3))
    return [hole.gain(*start) for start in starts.tolist()]


def test_a_finger_in_a_corner_gains_its_energy_from_its_motor() -> None:
    assert max(gains()) < SMALL


def test_in_short_steps_alone_it_gains_far_more(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(PhysicsStepper, "_crushed", lambda _: False)
    assert max(gains()) > 5 * SMALL


BALL = """<mujoco><option timestep="{short}" gravity="0 0 0"/><worldbody>
<geom type="plane" size="1 1 .1" {pad}/>
<body pos="0 0 .05"><joint type="slide" axis="0 0 1"/><geom size=".05" mass="1" {pad}/>
<site name="pad" size=".06"/></body></worldbody><sensor><touch site="pad"/></sensor></mujoco>"""


@pytest.mark.parametrize(("share", "fine"), [(0.8, False), (1.2, True)])
def test_a_period_in_which_a_finger_is_crushed_is_computed_again_in_fine_steps(
    share: float, fine: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A ball of 1 kg is stopped within a short step, by a share of the force that is accepted."""
    made, step = list[float](), mujoco.mj_step

    def noted(model: mujoco.MjModel, data: mujoco.MjData, number: int = 1) -> None:
        made.extend([model.opt.timestep] * number)
        step(model, data, number)

    monkeypatch.setattr(mujoco, "mj_step", noted)
    model = mujoco.MjModel.from_xml_string(BALL.format(short=SHORT, pad=PAD))
    data = mujoco.MjData(model)
    data.qpos[0], data.qvel[0] = -1e-6, -share * CRUSHING * SHORT
    mujoco.mj_forward(model, data)
    PhysicsStepper(model, data).step(PERIOD)
    assert (made[-PERIOD * FINER :] == [SHORT / FINER] * PERIOD * FINER) == fine
    assert data.time == pytest.approx(PERIOD * SHORT)
