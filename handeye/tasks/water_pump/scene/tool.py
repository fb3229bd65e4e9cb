"""Adds the powered screwdriver with its magnetic bit, in its rack."""

from math import cos, pi, sin, sqrt
from typing import Final

import mujoco

from handeye.cell.looks import SEEN
from handeye.tasks.stanford_cell.dimensions import dimensions
from handeye.tasks.stanford_cell.shapes import Bore, Shaper, body_inertia
from handeye.tasks.water_pump.scene.fixtures import Fixture, add_fixture
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.tasks.water_pump.world.stations import Station

_POLES: Final = 6
"""Number of poles of the bit's magnet. The poles lie on a circle that divides the face of a screw head into two equal
areas. MuJoCo's adhesion acts only where geoms are near each other. With poles on such a circle, the magnet pulls the
whole face of a head that hangs by its edge, and so straightens the head.
"""
_POLE: Final = 5e-4  # m, radius: they lie within the bit, a twentieth of a millimetre behind its face


def add_driver(shaper: Shaper, world: PumpWorld) -> None:
    """Add the rack, and the screwdriver that hangs in it: a square grip block with a spindle below."""
    d = dimensions()
    x, y = d.all("rack.place")
    fixture = add_fixture(shaper, world, Station.RACK, (x, y))
    _add_rack(shaper, fixture)
    half, high = d("driver.width") / 2, d("driver.height") / 2
    body = fixture.stand(shaper, "driver", x, y, d("rack.height") + high, error=world.parts["driver"])
    body_inertia(body, d("driver.mass"), (0.0, 0.0, 0.0), (3e-4, 3e-4, 8e-5))
    shaper.box(body, "grip", (-half, -half, -high), (half, half, high), "red", "driver").group = 2
    for z in (-high * 0.93, high * 0.93):
        out = half + 2e-4
        shaper.box(body, "look", (-out, -out, z - 0.002), (out, out, z + 0.002), "black")
    shaper.cylinder(body, "look", 0.004, (0, 0, high), (0, 0, high + 0.018), "black")
    body.add_site(name="driver", group=5)
    _add_spindle(shaper, body)
    _add_drives(shaper.spec)


def _add_spindle(shaper: Shaper, driver: mujoco.MjsBody) -> None:
    """Add the bit: a flat driving face inside a ring that keeps the screw head from sliding off."""
    d = dimensions()
    length = d("driver.bit")
    body = driver.add_body(name="bit", pos=[0.0, 0.0, -d("driver.height") / 2 - length])
    body_inertia(body, 0.03, (0.0, 0.0, 0.02), (4e-6, 4e-6, 1e-6))
    body.add_joint(
        name="spindle", type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 0, 1], armature=2e-4, damping=1e-4
    )
    body.add_site(name="bit", group=5)
    shaper.cylinder(body, "bit", 0.0065, (0, 0, 0), (0, 0, 0.008), name="bit")
    for k in range(_POLES):
        angle, out = 2 * pi * k / _POLES, d("screw.head_radius") / sqrt(2)
        pole = shaper.ball(body, "pole", _POLE, (out * cos(angle), out * sin(angle), 1.1 * _POLE))
        pole.gap = d("driver.magnet_reach")
    ring = Bore(radius=d("screw.head_radius") + 0.0003, outer=0.0085, height=0.003, below=0.002, sectors=8)
    brass = body.add_body(
        name="socket"
    )  # a body of its own: the magnet pulls on the bit's face, not on the ring
    shaper.ring(brass, "socket", ring, (0.0, 0.0, -0.0025), lambda _: "socket")
    shaper.cylinder(body, "housing", 0.0085, (0, 0, 0.0005), (0, 0, 0.014), name="housing")
    shaper.cylinder(body, "look", 0.006, (0, 0, 0.012), (0, 0, length), "steel")
    shaper.cylinder(body, "look", 0.0085, (0, 0, 0), (0, 0, 0.014), "brass")


def _add_rack(shaper: Shaper, fixture: Fixture) -> None:
    """Add the rack: four posts that guide the corners of the grip block, and a square guide with a lead-in. The
    spindle hangs between the posts.

    The socket at the end of the spindle enters between the posts before the block reaches the guide. The clearance
    between the socket and the posts is therefore greater than the lead-in of the guide.
    """
    d = dimensions()
    (x, y), height = d.all("rack.place"), d("rack.height")
    inner, outer = d("rack.posts") / 2, d("driver.width") / 2 + d("rack.play")
    for across, along in ((-1, -1), (-1, 1), (1, -1), (1, 1)):
        x0, x1 = sorted((x + across * inner, x + across * outer))
        y0, y1 = sorted((y + along * inner, y + along * outer))
        shaper.box(fixture.body, "solid", (x0, y0, 0.006), (x1, y1, height), "enamel").group = SEEN
    near, lead = d("driver.width") / 2 + d("rack.play"), d("rack.lead")
    guide = Bore(radius=near, outer=near + lead + 0.002, height=0.028, above=lead, sectors=4)
    for wedge in shaper.ring(fixture.body, "guide", guide, (x, y, height - 0.02), lambda _: "solid"):
        wedge.group, wedge.material = 2, "enamel"
    shaper.box(fixture.body, "look", (x - 0.04, y - 0.04, 0.0), (x + 0.04, y + 0.04, 0.006), "enamel")


def _add_drives(spec: mujoco.MjSpec) -> None:
    """Add the spindle motor, the thread drive and the magnet.

    The motor `drive` turns a thread's carrier, and its reaction torque acts on the driver. If a joint equality turned
    the carrier instead, the torques would cancel inside the driver, and the arm would feel nothing. The cell connects
    `drive` to the carrier of the engaged screw and sets its gains.
    """
    d = dimensions()
    spin = spec.add_actuator(name="spindle", trntype=mujoco.mjtTrn.mjTRN_JOINT, target="spindle")
    spin.set_to_velocity(kv=0.02)
    spin.forcelimited = True
    spin.forcerange[:] = [-0.05, 0.05]  # for the spindle alone: the thread has a drive of its own
    site, gear = mujoco.mjtTrn.mjTRN_SITE, [0, 0, 0, 0, 0, 1]
    drive = spec.add_actuator(name="drive", trntype=site, target="thread0", refsite="driver", gear=gear)
    drive.set_to_velocity(kv=0.0)
    drive.forcelimited = True
    drive.forcerange[:] = [-d("driver.torque"), d("driver.loosening")]  # negative: clockwise, which fastens
    magnet = spec.add_actuator(name="magnet", trntype=mujoco.mjtTrn.mjTRN_BODY, target="bit")
    magnet.set_to_adhesion(gain=d("driver.magnet"))
    magnet.ctrllimited = True
    magnet.ctrlrange[:] = [0.0, 1.0]
