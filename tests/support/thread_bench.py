"""A bench for threads alone: one tapped hole, one screw, and a driver that is pressed down and yields sideways."""

from collections.abc import Callable
from dataclasses import dataclass
from math import acos, cos, degrees, pi, sin, tan

import mujoco
import numpy as np

from handeye.cell.arm import Watchdog
from handeye.cell.hand import SimulatedScrewdriver
from handeye.cell.threads import Thread, ThreadFigures, Threads
from handeye.core.pose import Pose, pose
from handeye.core.units import JIFFY

MOUTH = 0.05  # m, height of the hole's mouth
LENGTH, HEAD = 0.01905, 0.004  # m, screw under the head; head
FLANGE = 0.0091  # m, clamped thickness: gasket and flange
PITCH = 0.00127
SPEED = 20.0  # rad/s
STOP = 0.28  # N m
WEIGHT = 0.51 * 9.81  # N, of the driver

_RING = """
<option timestep="{step}" integrator="implicitfast" cone="elliptic" impratio="50">
  <flag diagexact="enable" filterparent="disable"/></option>
<size memory="10M"/>
<default>
  <geom solref="{solref} 1" solimp=".95 .99 .0005" friction=".2 .002 .0001"/>
  <default class="bore"><geom type="mesh" contype="4" conaffinity="0" mass="0"/></default>
  <default class="socket"><geom type="mesh" contype="0" conaffinity="8" mass="0"/></default>
  <default class="seat"><geom type="box" size=".02 .004 .004" solimp=".99 .999 .0001" contype="16" mass="0"
   conaffinity="0"/></default>
  <default class="hard"><geom solimp=".99 .999 .0001" friction=".2 .002 .0001"/></default>
  <joint solreffriction=".004 1" solimpfriction=".999 .9999 .001"/>
</default>
"""


def _wedges(
    name: str, radius: float, outer: float, height: float, chamfer: float, z: float, count: int = 12
) -> tuple[str, str]:
    """Mesh asset and geoms of a chamfered hole, from z = 0 to `height`."""
    half = pi / count
    profile = [
        (radius, 0),
        (radius, height - chamfer),
        (radius + chamfer, height),
        (outer, height),
        (outer, 0),
    ]
    points = [(r, r * tan(side), z) for side in (-half, half) for r, z in profile]
    mesh = f'<mesh name="{name}" vertex="{" ".join(f"{x:.7f}" for p in points for x in p)}"/>'
    turns = [(cos(pi * i / count), sin(pi * i / count)) for i in range(count)]
    geoms = [f'<geom class="bore" mesh="{name}" pos="0 0 {z}" quat="{c} 0 0 {s}"/>' for c, s in turns]
    return mesh, "".join(geoms)


def scene(offset: float, tilt: float) -> str:
    """Return the MJCF of the bench, with the driver `offset` (m) beside the hole and tilted by `tilt` (rad)."""
    ring, ring_geoms = _wedges("tap", 0.00255, 0.0095, 0.021, 0.001, -0.021)
    sock, sock_geoms = _wedges("sock", 0.0058, 0.0085, 0.003, 0.0, -0.0025)
    sock_geoms = sock_geoms.replace("bore", "socket")
    reach = LENGTH + HEAD  # bit face over the tip; the driver's frame is at the tip's start point
    top, lead = LENGTH + HEAD / 2, PITCH / 2 / pi
    lean = f"{cos(tilt / 2)} {sin(tilt / 2)} 0 0"
    return f"""<mujoco>{_RING.format(step=1 / 960, solref=2 / 960)}<asset>{ring}{sock}</asset><worldbody>
<site name="park0" pos="1 0 -1"/><geom type="box" pos="1 0 -1.01" size=".1 .1 .01" conaffinity="8"/>
<body name="block" pos="0 0 {MOUTH}"><freejoint name="block"/>
 <inertial pos="0 0 -.03" mass="2" diaginertia=".01 .01 .01"/>
 {ring_geoms}
 <geom class="seat" pos="0 .008 {FLANGE - 0.004}"/><geom class="seat" pos="0 -.008 {FLANGE - 0.004}"/>
 <body name="carrier0"><joint name="thread_slide0" type="slide" axis="0 0 1" range="-.025 .002" limited="true"
   armature=".02" damping=".5"/><joint name="thread_turn0" axis="0 0 1" armature="1e-3" damping="1e-4"/>
  <inertial pos="0 0 0" mass=".005" diaginertia="1e-7 1e-7 1e-7"/><site name="thread0"/>
  <geom name="head0" class="hard" type="cylinder" size=".0055 {HEAD / 2}" pos="0 0 {top}" mass="0"
   contype="8" conaffinity="16" condim="4" priority="1"/>
  <geom name="shank0" type="cylinder" size=".00305 .008" pos="0 0 .011" mass="0" contype="0" conaffinity="32"
   priority="1"/></body></body>
<body name="screw0" pos="0 {offset} {MOUTH + 0.002}" quat="{lean}"><freejoint name="screw0"/>
 <geom type="cylinder" size=".00305 .008" pos="0 0 .011" contype="8" conaffinity="4" density="7800"/>
 <geom type="cylinder" size=".0022 .0015" pos="0 0 .0015" contype="8" conaffinity="4" density="7800"/>
 <geom name="screw_head0" class="hard" type="cylinder" size=".0055 {HEAD / 2}" pos="0 0 {LENGTH + HEAD / 2}"
  contype="8" conaffinity="0" condim="4" density="7800" priority="1"/></body>
<body name="driver" pos="0 {offset} {MOUTH + 0.002}" quat="{lean}">
 <joint name="press" type="slide" axis="0 0 1" damping="100" armature="2"/>
 <joint type="slide" axis="1 0 0" damping="300" armature="2"/>
 <joint type="slide" axis="0 1 0" damping="300" armature="2"/>
 <inertial pos="0 0 0" mass=".48" diaginertia="3e-4 3e-4 8e-5"/>
 <body name="bit" pos="0 0 {reach}"><joint name="spindle" axis="0 0 1" armature="2e-4" damping="1e-4"/>
  <inertial pos="0 0 .02" mass=".03" diaginertia="4e-6 4e-6 1e-6"/>
  <geom name="bit" type="cylinder" size=".0065 .004" pos="0 0 .004" contype="0" conaffinity="8" condim="4" mass="0"
   friction=".8 .003 .0001" priority="2"/>{sock_geoms}</body><site name="reaction"/></body>
</worldbody>
<equality><joint joint1="thread_slide0" joint2="thread_turn0" polycoef="0 {lead} 0 0 0"
  solref=".004 1" solimp=".999 .9999 .0001"/>
 <weld body1="block" relpose="0 0 {-MOUTH} 1 0 0 0" anchor="0 0 0" solref=".004 1"/></equality>
<actuator><general name="spindle" joint="spindle" gainprm=".02" biastype="affine" biasprm="0 0 -.02"
  forcelimited="true" forcerange="-.05 .05"/>
 <general name="drive" site="thread0" refsite="reaction" gear="0 0 0 0 0 1" biastype="affine"
  forcelimited="true" forcerange="-.32 .32"/>
 <adhesion name="magnet" body="bit" ctrlrange="0 1" gain="6"/></actuator></mujoco>"""


class ThreadBench:
    """The bench during the simulation."""

    def __init__(
        self, *, offset: float = 0.0, tilt: float = 0.0, slipping: frozenset[int] = frozenset()
    ) -> None:
        self.model = mujoco.MjModel.from_xml_string(scene(offset, tilt))
        self.data = mujoco.MjData(self.model)
        self.driver = SimulatedScrewdriver(
            self.model, self.data, ("drive", "spindle"), torque_noise=0.0, noise=np.random.default_rng(0),
            watchdog=Watchdog(JIFFY),
        )  # fmt: skip
        self.threads = Threads(
            self.model, self.data, self.driver, ThreadFigures(phases=(1.0,), slipping=slipping)
        )

    @property
    def thread(self) -> Thread:
        return self.threads.holes[0]

    @property
    def screw(self) -> Pose:
        """`X_WS` of the screw, loose or in its thread."""
        body = self.data.body("screw0" if self.thread.screw is None else "carrier0")
        return pose(body.xmat.reshape(3, 3).copy(), body.xpos.copy())

    @property
    def tilt(self) -> float:
        """Of the screw, deg."""
        return degrees(acos(min(1.0, self.screw[2, 2])))

    @property
    def head_gap(self) -> float:
        """Of the head over where it belongs, m."""
        return float((self.screw @ (0.0, 0.0, LENGTH, 1.0))[2] - self.data.body("block").xpos[2] - FLANGE)

    def tick(self, speed: float, press: float) -> None:
        """Turn (rad/s) and press (N) for a servo period."""
        self.data.qfrc_applied[self.model.joint("press").dofadr[0]] = WEIGHT - press
        self.driver.drive(speed)
        self.threads.before(JIFFY)
        mujoco.mj_step(self.model, self.data, 16)
        assert not any(w.number for w in self.data.warning)
        self.driver.after()

    def drive_until(self, done: Callable[[], bool], *, speed: float, press: float, seconds: float) -> None:
        """Turn and press until `done` returns True, or the time is over."""
        for _ in range(round(seconds / JIFFY)):
            self.tick(speed, press)
            if done():
                return


@dataclass(frozen=True, kw_only=True)
class Outcome:
    """How the screw ended."""

    thread: Thread
    torque: float
    """Of the motor, N m."""
    height: float
    """Of the head over where it belongs, m."""
    tilt: float
    """Of the screw, deg."""


def drive_screw(
    *, offset: float = 0.0, tilt: float = 0.0, seconds: float = 8.0, press: float = 6.0, speed: float = SPEED
) -> Outcome:
    """Press and turn until the motor's torque is too high or the time is over. Then switch the motor off."""
    bench = ThreadBench(offset=offset, tilt=tilt)
    bench.drive_until(lambda: bench.driver.torque() > STOP, speed=speed, press=press, seconds=seconds)
    torque = bench.driver.torque()
    for _ in range(20):
        bench.tick(0.0, press)
    return Outcome(thread=bench.thread, torque=torque, height=bench.head_gap, tilt=bench.tilt)
