"""The robots of the tests: the product's own, and toys of other structures. Each has the model that MuJoCo simulates.
The toys' models are written by hand in table axes, so that the Denavit-Hartenberg rows can be tested with them.
"""

from dataclasses import dataclass, replace
from math import pi
from typing import Literal

import mujoco
import numpy as np

from handeye.arm.model import ArmModel, ComplianceModel, GraspModel, HandModel, Joint, ServoModel, Structure
from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import Pose, pose
from handeye.core.resources import scenes
from handeye.core.units import DEGREE

Triple = tuple[float, float, float]

SMALL_HAND = HandModel(
    length=0.15, mass=0.16, centre=0.12, gap_max=0.08, gap_speed=0.08, grip=30.0,
    finger_width=0.016, finger_thickness=0.010, finger_length=0.06,
    palm=(-0.02, -0.055, -0.08, 0.02, 0.055, -0.06), wrist=(-0.02, -0.02, -0.15, 0.02, 0.02, -0.08),
    grasp=GraspModel(speed=0.05, centring=0.0127, settle=20),
)  # fmt: skip
"""Two fingers of 80 g, 6 cm long."""

YIELDING = ComplianceModel(
    gain=0.0015, speed=0.0127, turn_gain=0.1, turn_speed=0.1, turn_limit=15 * DEGREE, ramp=6, friction=(),
)  # fmt: skip

_RUBS = {"slide": 1.5, "turn": 0.1}
"""Expected Coulomb friction of a joint, N or N m."""

_ALONG_X = np.array([[0.0, 0.0, 1.0], [0.0, -1.0, 0.0], [1.0, 0.0, 0.0]])
"""A base frame whose z, the first axis, is table x, and whose x is up."""


def _slide(
    name: str, lower: float, upper: float, *, alpha: float, theta: float, mass: float, centre: Triple, effort: float
) -> Joint:  # fmt: skip
    return Joint(
        name=name, kind="prismatic", d=0.0, alpha=alpha, theta=theta, lower=lower, upper=upper,
        speed=1.0, acceleration=2.0, effort=effort, mass=mass, centre=centre, inertia=(0.02, 0.03, 0.04),
        armature=1.0, damping=10.0, brake=2 * effort,
    )  # fmt: skip


def _turn(name: str, limit: float, *, d: float, alpha: float, mass: float, centre: Triple) -> Joint:
    return Joint(
        name=name, kind="revolute", d=d, alpha=alpha, lower=-limit, upper=limit,
        speed=4.0, acceleration=8.0, effort=15.0, mass=mass, centre=centre, inertia=(0.002, 0.0025, 0.003),
        armature=0.05, damping=0.2, brake=30.0,
    )  # fmt: skip


def _servo(*kinds: Literal["slide", "turn"]) -> ServoModel:
    return ServoModel(
        period=1 / 60, frequency=tuple({"slide": 25.0, "turn": 40.0}[kind] for kind in kinds),
        lag=tuple({"slide": 0.03, "turn": 0.15}[kind] for kind in kinds), short=0.004, settle=8, drag=0.1,
    )  # fmt: skip


def _arm(
    name: str, structure: Structure, base: Triple, joints: tuple[Joint, ...], held: dict[str, float] | None = None
) -> ArmModel:  # fmt: skip
    kinds = ["slide" if joint.kind == "prismatic" else "turn" for joint in joints]
    return ArmModel(
        name=name, structure=structure, joints=joints, X_WB=pose(_ALONG_X, base), hand=SMALL_HAND,
        servo=_servo(*kinds), compliance=replace(YIELDING, friction=tuple(_RUBS[kind] for kind in kinds)),
        held=held or {},
    )  # fmt: skip


_DOWN = {"alpha": 0.0, "theta": pi, "mass": 1.5, "centre": (0.0, 0.0, -0.3), "effort": 100.0}

GANTRY = _arm(
    "gantry", "gantry", (0.0, 0.0, 1.2),
    (
        _slide("rail", 0.0, 1.0, alpha=pi / 2, theta=0.0, mass=20.0, centre=(0.1, 0.2, 0.3), effort=300.0),
        _slide("bridge", 0.1, 1.5, alpha=-pi / 2, theta=0.0, mass=8.0, centre=(0.0, 0.1, 0.0), effort=200.0),
        _slide("carriage", -0.2, 1.0, alpha=pi / 2, theta=-pi / 2, mass=4.0, centre=(0.02, 0.0, 0.0), effort=150.0),
        _slide("mast", 0.0, 1.05, alpha=0.0, theta=0.0, mass=3.0, centre=(0.0, 0.01, -0.4), effort=150.0),
        _turn("roll", 170 * DEGREE, d=0.0, alpha=-pi / 2, mass=0.8, centre=(0.0, 0.03, 0.01)),
        _turn("pitch", 100 * DEGREE, d=0.0, alpha=pi / 2, mass=0.6, centre=(0.01, 0.0, 0.02)),
        _turn("hand roll", 170 * DEGREE, d=0.15, alpha=0.0, mass=0.4, centre=(0.0, 0.0, -0.1)),
    ),
    held={"rail": 0.25},
)  # fmt: skip
"""Seven joints: on a rail along table x, held at .25 m, three slides along y, x and downwards, and a wrist that rolls,
pitches and rolls. When the hand points straight down, as it usually does, both roll axes are in line."""

CARTESIAN = _arm(
    "cartesian", "cartesian", (0.0, 0.0, 0.8),
    (
        _slide("x", 0.0, 1.2, alpha=pi / 2, theta=0.0, mass=6.0, centre=(0.0, 0.0, 0.1), effort=200.0),
        _slide("y", 0.1, 1.3, alpha=-pi / 2, theta=pi / 2, mass=3.0, centre=(0.05, 0.0, 0.0), effort=150.0),
        _slide("z", 0.0, 0.8, **_DOWN),
    ),
)  # fmt: skip
"""Three slides, along table x, y and downwards; the hand points down, its finger line along y."""

PLANAR = _arm(
    "planar", "cartesian", (0.0, 0.95, 0.8),
    (
        _slide("x", 0.0, 1.2, alpha=pi / 2, theta=-pi / 2, mass=6.0, centre=(0.0, 0.0, 0.1), effort=200.0),
        _slide("z", 0.0, 0.8, **{**_DOWN, "theta": -pi / 2}),
    ),
)  # fmt: skip
"""Two slides, along table x and downwards, over the line y = .95 m."""

_FINGERS = """
<site name="tool" pos="0 0 {length}"/>
<body name="finger_a" pos="0 0 {root}">
  <inertial pos="0 .005 {middle}" mass=".08" diaginertia="2e-5 2e-5 4e-6"/>
  <joint name="finger_a" type="slide" axis="0 1 0" range="0 .04" armature=".2" damping="10"/>
  <geom type="box" size=".008 .005 .03" pos="0 .005 .03" contype="2" conaffinity="1"/>
  <site name="switch_a" type="box" pos="0 0 .05" size=".01 .003 .012"/>
</body>
<body name="finger_b" pos="0 0 {root}">
  <inertial pos="0 -.005 {middle}" mass=".08" diaginertia="2e-5 2e-5 4e-6"/>
  <joint name="finger_b" type="slide" axis="0 -1 0" range="0 .04" armature=".2" damping="10"/>
  <geom type="box" size=".008 .005 .03" pos="0 -.005 .03" contype="2" conaffinity="1"/>
  <site name="switch_b" type="box" pos="0 0 .05" size=".01 .003 .012"/>
</body>
"""
"""The hand, in the frame of the wrist centre with z towards the finger tips."""


def _hand(wrist: float) -> str:
    """Return the fingers, on a link whose frame has the wrist centre at `wrist` (m) along z."""
    tip = wrist + SMALL_HAND.length
    return _FINGERS.format(length=tip, root=tip - 0.06, middle=0.03)


def _mjcf(name: str, bodies: str, motors: list[tuple[str, float]]) -> str:
    drives = "".join(
        f'<motor name="{joint}" joint="{joint}" ctrlrange="-{effort} {effort}"/>' for joint, effort in motors
    )
    return f"""<mujoco model="{name}"><compiler angle="degree" autolimits="true"/>
<option gravity="0 0 -9.81" integrator="implicitfast"/>
<worldbody>{bodies}</worldbody>
<tendon><fixed name="gap"><joint joint="finger_a" coef="1"/><joint joint="finger_b" coef="1"/></fixed></tendon>
<equality><joint joint1="finger_a" joint2="finger_b" polycoef="0 1 0 0 0"/></equality>
<actuator>{drives}<general name="grip" tendon="gap" dyntype="integrator" biastype="affine" gainprm="2000"
 biasprm="0 -2000 -50" forcerange="-30 30"/></actuator>
<sensor><touch name="switch_a" site="switch_a"/><touch name="switch_b" site="switch_b"/></sensor>
</mujoco>"""


_SLIDE = 'type="slide" armature="1" damping="10"'
_TURN = 'armature=".05" damping=".2"'
_DOWNWARDS = 'quat="0 0.70710678118654752 0.70710678118654752 0"'  # x is table y, y is table x, z is down
_TO_Y = 'quat="0 1 0 0"'  # y is table -y, z is down
_FINGERS_ALONG_Y = 'quat="0 0 1 0"'  # x is table -x, y is table y, z is down

GANTRY_MJCF = _mjcf(
    "gantry",
    f"""
<body name="link1" pos="0 0 1.2"> <joint name="j1" axis="1 0 0" range="0 1" {_SLIDE}/>
 <inertial pos=".2 .3 .1" mass="20" diaginertia=".03 .04 .02"/>
 <body name="link2"> <joint name="j2" axis="0 1 0" range=".1 1.5" {_SLIDE}/>
  <inertial pos="0 -.1 0" mass="8" diaginertia=".04 .03 .02"/>
  <body name="link3"> <joint name="j3" axis="1 0 0" range="-.2 1" {_SLIDE}/>
   <inertial pos="0 .02 0" mass="4" diaginertia=".03 .02 .04"/>
   <body name="link4" {_DOWNWARDS}> <joint name="j4" axis="0 0 1" range="0 1.05" {_SLIDE}/>
    <inertial pos="0 .01 -.4" mass="3" diaginertia=".02 .03 .04"/>
    <body name="link5"> <joint name="j5" axis="0 0 1" range="-170 170" {_TURN}/>
     <inertial pos="0 .01 -.03" mass=".8" diaginertia=".002 .003 .0025"/>
     <body name="link6"> <joint name="j6" axis="0 1 0" range="-100 100" {_TURN}/>
      <inertial pos=".01 0 .02" mass=".6" diaginertia=".002 .0025 .003"/>
      <body name="link7"> <joint name="j7" axis="0 0 1" range="-170 170" {_TURN}/>
       <inertial pos="0 0 .05" mass=".4" diaginertia=".002 .0025 .003"/>{_hand(0.0)}
      </body></body></body></body></body></body></body>""",
    [("j1", 300), ("j2", 200), ("j3", 150), ("j4", 150), ("j5", 15), ("j6", 15), ("j7", 15)],
)

CARTESIAN_MJCF = _mjcf(
    "cartesian",
    f"""
<body name="link1" pos="0 0 .8"> <joint name="j1" axis="1 0 0" range="0 1.2" {_SLIDE}/>
 <inertial pos="0 .1 0" mass="6" diaginertia=".03 .04 .02"/>
 <body name="link2"> <joint name="j2" axis="0 1 0" range=".1 1.3" {_SLIDE}/>
  <inertial pos=".05 0 0" mass="3" diaginertia=".02 .03 .04"/>
  <body name="link3" {_FINGERS_ALONG_Y}> <joint name="j3" axis="0 0 1" range="0 .8" {_SLIDE}/>
   <inertial pos="0 0 -.3" mass="1.5" diaginertia=".02 .03 .04"/>{_hand(-0.15)}
  </body></body></body>""",
    [("j1", 200), ("j2", 150), ("j3", 100)],
)

PLANAR_MJCF = _mjcf(
    "planar",
    f"""
<body name="link1" pos="0 .95 .8"> <joint name="j1" axis="1 0 0" range="0 1.2" {_SLIDE}/>
 <inertial pos="0 0 -.1" mass="6" diaginertia=".03 .02 .04"/>
 <body name="link2" {_FINGERS_ALONG_Y}> <joint name="j2" axis="0 0 1" range="0 .8" {_SLIDE}/>
   <inertial pos="0 0 -.3" mass="1.5" diaginertia=".02 .03 .04"/>{_hand(-0.15)}
  </body></body>""",
    [("j1", 200), ("j2", 100)],
)


@dataclass(frozen=True, kw_only=True)
class Robot:
    """A robot value, and the model that MuJoCo runs."""

    arm: ArmModel
    mjcf: str
    X_WM: Pose
    """The place of the model in the world."""

    def model(self) -> mujoco.MjModel:
        """Compiled."""
        return mujoco.MjModel.from_xml_string(self.mjcf)


ROBOTS = {
    "stanford": Robot(
        arm=STANFORD, mjcf=(scenes() / "stanford_arm" / "stanford.xml").read_text(), X_WM=STANFORD.X_WB
    ),
    "gantry": Robot(arm=GANTRY, mjcf=GANTRY_MJCF, X_WM=np.eye(4)),
    "cartesian": Robot(arm=CARTESIAN, mjcf=CARTESIAN_MJCF, X_WM=np.eye(4)),
    "planar": Robot(arm=PLANAR, mjcf=PLANAR_MJCF, X_WM=np.eye(4)),
}
