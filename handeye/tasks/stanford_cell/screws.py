"""Adds pins, screws, tapped holes, and the bit that drives the screws. `handeye/cell/threads.py` simulates the
threads. A scene that uses the shapes must also use the styles that `add_styles` defines. Places and lengths are in mm,
with z up.
"""

from math import cos, nan, pi, sin, sqrt
from typing import Final, NamedTuple

import mujoco
import numpy as np

from handeye.cell.looks import LATENT, SEEN
from handeye.core.pose import Array
from handeye.tasks.stanford_cell.shapes import Bore, Shaper, body_inertia

MM: Final = 0.001
STEEL: Final = 7800.0  # kg/m3
ALUMINIUM: Final = 2700.0

SHANK: Final = 3.05  # radius of a 1/4-20 screw
POINT: Final = 2.2  # radius of the point
POINT_LENGTH: Final = 3.0
LENGTH: Final = 19.05  # length below the head
PITCH: Final = 1.27  # twenty threads an inch
HEAD: Final = 5.5  # radius
HEAD_HEIGHT: Final = 6.0
TAP: Final = 2.55  # radius, slightly greater than that of the core of a 1/4-20 screw, as in the pump
TAP_DEPTH: Final = 21.0
SCREW_BORE: Final = 3.772  # radius: a loose clearance hole of a 1/4 in screw, as in the pump
HUNG_BORE: Final = 3.4  # radius of the holes in which screws hang by their heads
PIN_RADIUS: Final = 4.0
PIN_LENGTH: Final = 38.0
PIN_POINT: Final = 2.2  # radius of the lower end
PIN_TAPER: Final = 4.0  # length of the taper
CHAMFER: Final = 1.0
LAND: Final = 9.5  # radius of the metal around a hole that fasteners can touch
RING: Final = 1.5  # depth of the bit's ring below the bit's face
TORQUE: Final = 0.32  # N m at which the clutch slips, as in the pump's screwdriver
SPIN: Final = 0.01
"""Torque on a loose screw (N m). This torque must be less than the friction between bit and head, because the
simulated head has no slot that would keep the bit from slipping.
"""
LOOSENING: Final = 0.8  # N m, greatest torque to loosen a screw
MAGNET: Final = 2.0  # N
_REACH: Final = 0.001  # m from the face at which the magnet still draws a head
_POLES: Final = 6
_SECTORS: Final = 8  # wedges of a hole: they give a round pin 8 % more play in some directions, and save time
_POLE: Final = 5e-4  # m


class Place(NamedTuple):
    """A place on a table, or on a part."""

    x: float
    y: float


# Contact bits: 1 the machine, the board and fixtures; 2 what only the arms touch; 4 bores; 8 loose parts; 16 seats of
# heads; 32 the face of the base; 64 tapped holes. A rib stands on a face. It collides with everything
# that collides with a base.
_STYLES: Final[dict[str, tuple[int, int]]] = {
    "fixed": (1, 9),
    "base": (1, 1),
    "face": (32, 0),
    "rib": (33, 1),
    "plate": (8, 34),
    "bore": (4, 0),
    "tap": (64, 0),
    "seat": (16, 0),
    "pin": (8, 6),
    "shank": (8, 70),
    "head": (8, 18),
    "threaded": (0, 4),
    "driver": (3, 9),
    "bit": (3, 8),
    "pole": (0, 8),
    "look": (0, 0),
}
_COLOURS: Final = {
    "iron": (0.33, 0.35, 0.36, 1),
    "plate": (0.70, 0.71, 0.72, 1),
    "dark": (0.12, 0.12, 0.13, 1),
    "pin": (0.88, 0.82, 0.66, 1),
    "screw": (0.62, 0.62, 0.64, 1),
    "enamel": (0.28, 0.42, 0.36, 1),
    "brass": (0.66, 0.52, 0.24, 1),
    "steel": (0.55, 0.56, 0.58, 1),
}


def add_styles(spec: mujoco.MjSpec) -> None:
    """Add the colours, and the default classes of shapes. The class of a shape determines which other shapes it can
    touch.
    """
    for name, (contype, conaffinity) in _STYLES.items():
        style = spec.find_default(name) or spec.add_default(name, spec.default)
        geom = style.geom
        geom.contype, geom.conaffinity, geom.mass, geom.group = contype, conaffinity, 0.0, 3
        geom.solref[:], geom.solimp[:3] = [0.004, 1.0], [0.95, 0.99, 0.0005]
        geom.friction[:] = [0.2, 0.002, 0.0001]
        geom.condim = 3
        if name in ("head", "seat", "bit"):
            geom.solimp[:3] = [0.99, 0.999, 0.0001]
        if name in ("face", "rib", "plate"):
            geom.solimp[:3] = [0.999, 0.9999, 0.0001]
    spec.find_default("head").geom.condim = 4
    for name in ("head", "threaded"):
        spec.find_default(name).geom.priority = 1
    bit = spec.find_default("bit").geom
    bit.condim, bit.priority, bit.friction[:] = 4, 2, [0.8, 0.003, 0.0001]
    for name, rgba in _COLOURS.items():
        spec.add_material(name=name, rgba=list(rgba), specular=0.3, shininess=0.4)


def add_box(
    shaper: Shaper,
    body: mujoco.MjsBody,
    style: str,
    at: Place,
    size: tuple[float, ...],
    low: float,
    colour: str = "",
) -> mujoco.MjsGeom:
    """Add a box. Its middle has the x and y of a place, and its underside has the height `low` (mm)."""
    x, y, z = (each * MM for each in size)
    geom = shaper.box(
        body,
        style,
        (at.x * MM - x / 2, at.y * MM - y / 2, low * MM),
        (at.x * MM + x / 2, at.y * MM + y / 2, low * MM + z),
        colour or None,
    )
    if colour:
        geom.group = SEEN
    return geom


def add_ring(
    shaper: Shaper, body: mujoco.MjsBody, mesh: str, style: str, at: Place, top: float, radius: float, depth: float,
    *, below: float = 0.0, outer: float = LAND,
) -> None:  # fmt: skip
    """Add a hole whose mouth is at the height `top` (mm), and discs that make it visible."""
    bore = Bore(
        radius=radius * MM,
        outer=outer * MM,
        height=depth * MM,
        above=CHAMFER * MM,
        below=below * MM,
        sectors=_SECTORS,
    )
    place = (at.x * MM, at.y * MM, (top - depth) * MM)
    shaper.ring(body, mesh, bore, place, lambda _: style)
    mouth = (at.x * MM, at.y * MM, top * MM)
    add_disc(shaper, body, radius + CHAMFER, mouth, "steel", 1e-4)
    add_disc(shaper, body, radius, mouth, "dark", 2e-4)


def add_disc(
    shaper: Shaper, body: mujoco.MjsBody, radius: float, at: tuple[float, ...], colour: str, z: float
) -> None:
    x, y, top = at
    shaper.cylinder(body, "look", radius * MM, (x, y, top - 1e-4), (x, y, top + z), colour).group = SEEN


def add_loose(shaper: Shaper, name: str, at: Place, z: float) -> mujoco.MjsBody:
    """Add a free body at a place and a height (mm)."""
    body = shaper.spec.worldbody.add_body(name=name, pos=[at.x * MM, at.y * MM, z * MM])
    body.add_freejoint(name=name)
    return body


def add_thread(shaper: Shaper, base: mujoco.MjsBody, number: int, at: Place, height: float) -> None:
    """Add the carrier that represents a screw in its thread. `handeye/cell/threads.py` needs one carrier for each
    thread.
    """
    carrier = base.add_body(name=f"carrier{number}", pos=[at.x * MM, at.y * MM, height * MM])
    carrier.gravcomp = 1.0
    body_inertia(carrier, 0.005, (0.0, 0.0, 0.0), (1e-7, 1e-7, 1e-7))
    slide, hinge = mujoco.mjtJoint.mjJNT_SLIDE, mujoco.mjtJoint.mjJNT_HINGE
    carrier.add_joint(
        name=f"thread_slide{number}", type=slide, axis=[0, 0, 1], range=[-0.025, 0.002], armature=0.02,
        damping=[0.5, 0, 0],
    )  # fmt: skip
    carrier.add_joint(
        name=f"thread_turn{number}", type=hinge, axis=[0, 0, 1], armature=1e-3, damping=[1e-4, 0, 0]
    )
    for joint in carrier.joints:
        joint.solref_friction[:], joint.solimp_friction[:3] = [0.004, 1.0], [0.999, 0.9999, 0.001]
    carrier.add_site(name=f"thread{number}", group=5)
    head, shank = _screw_shapes(shaper, carrier, "head", "threaded", f"head{number}", f"shank{number}")
    for geom in (head, shank):
        geom.density, geom.group = 0.0, LATENT
    equality = shaper.spec.add_equality(
        name=f"thread{number}", type=mujoco.mjtEq.mjEQ_JOINT,
        name1=f"thread_slide{number}", name2=f"thread_turn{number}", solref=[0.004, 1.0],
    )  # fmt: skip
    equality.solimp[:3] = [0.999, 0.9999, 0.0001]
    equality.data[:5] = [0.0, PITCH * MM / (2 * pi), 0.0, 0.0, 0.0]


def _screw_shapes(
    shaper: Shaper, body: mujoco.MjsBody, head: str, shank: str, head_name: str, shank_name: str
) -> tuple[mujoco.MjsGeom, mujoco.MjsGeom]:
    """Add the head and the shank of a screw to a body. The body's origin is the point of the screw."""
    top = LENGTH + HEAD_HEIGHT
    first = shaper.cylinder(
        body, head, HEAD * MM, (0, 0, LENGTH * MM), (0, 0, top * MM), "screw", name=head_name
    )
    second = shaper.cylinder(
        body, shank, SHANK * MM, (0, 0, POINT_LENGTH * MM), (0, 0, LENGTH * MM), "screw", name=shank_name
    )
    return first, second


def add_hung_screw(shaper: Shaper, dispenser: mujoco.MjsBody, number: int, at: Place, top: float) -> None:
    """Add a hole to a dispenser whose upper side is at `top`, and a screw that hangs in the hole by its head. Also add
    a place, out of sight, where the screw's own body stays while a carrier represents the screw in a thread. The
    origin of a screw is its point.
    """
    add_ring(shaper, dispenser, "dispenser_hole", "bore", at, top, HUNG_BORE, 10)
    add_box(shaper, dispenser, "seat", at, (16, 16, 10), top - 10)
    body = add_loose(shaper, f"screw{number}", at, top - LENGTH)
    _screw_shapes(shaper, body, "head", "shank", f"screw_head{number}", "")[0].group = SEEN
    for geom in body.geoms:
        geom.group, geom.mass, geom.density = SEEN, nan, STEEL
    point = shaper.cylinder(body, "shank", POINT * MM, (0, 0, 0), (0, 0, POINT_LENGTH * MM), "screw")
    point.group, point.mass, point.density = SEEN, nan, STEEL
    park = (0.15 + 0.04 * number, 0.2, -1.0)
    shaper.spec.worldbody.add_site(name=f"park{number}", pos=park, group=5)


def add_pin(shaper: Shaper, body: mujoco.MjsBody) -> None:
    name, rows = "pin", [(PIN_POINT, 0.0), (PIN_RADIUS, PIN_TAPER), (PIN_RADIUS, PIN_LENGTH)]
    if shaper.spec.mesh(name) is None:
        shaper.convex(name, _turned(rows))
    geom = body.add_geom(
        shaper.style("pin"), type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, group=SEEN, density=STEEL
    )
    geom.mass = float("nan")
    geom.material = "pin"


def _turned(rows: list[tuple[float, float]], sides: int = 16) -> Array:
    """Return the corners (m) of a body of revolution. `rows` gives the radius and the height of each ring of corners,
    in mm.
    """
    angles = 2 * pi * np.arange(sides) / sides
    return (
        np.concatenate(
            [np.column_stack((r * np.cos(angles), r * np.sin(angles), np.full(sides, z))) for r, z in rows]
        )
        * MM
    )


def add_bit(shaper: Shaper, driver: mujoco.MjsBody, at: float) -> None:
    """Add the bit of a screwdriver: a flat face inside a ring, and the poles of a magnet. `at` is the height of
    the bit in the screwdriver's frame (mm). The screwdriver needs a site `driver`.
    """
    bit = driver.add_body(name="bit", pos=[0, 0, at * MM], gravcomp=driver.gravcomp)
    body_inertia(bit, 0.03, (0.0, 0.0, 0.02), (4e-6, 4e-6, 1e-6))
    hinge = mujoco.mjtJoint.mjJNT_HINGE
    bit.add_joint(name="spindle", type=hinge, axis=[0, 0, 1], armature=2e-5, damping=[1e-4, 0, 0])
    bit.add_site(name="bit", group=5)
    shaper.cylinder(bit, "bit", 0.0065, (0, 0, 0), (0, 0, 0.008), name="bit")
    for k in range(_POLES):
        angle, out = 2 * pi * k / _POLES, HEAD * MM / sqrt(2)
        pole = shaper.ball(bit, "pole", _POLE, (out * cos(angle), out * sin(angle), 1.1 * _POLE))
        pole.gap = _REACH
    ring = Bore(radius=(HEAD + 0.3) * MM, outer=0.0085, height=(RING + 0.5) * MM, below=1.2 * MM, sectors=8)
    # The ring is a body of its own, so that the magnet pulls on the face and not on the ring.
    brass = bit.add_body(name="socket", gravcomp=driver.gravcomp)
    for wedge in shaper.ring(brass, "socket", ring, (0.0, 0.0, -RING * MM), lambda _: "driver"):
        wedge.group, wedge.material = SEEN, "brass"
    shaper.cylinder(bit, "driver", 0.006, (0, 0, 0.001), (0, 0, 0.030), "steel").group = SEEN


def add_motors(spec: mujoco.MjSpec) -> None:
    """Add the spindle's motor, the magnet, and the drive of the threads. The torque of this drive also acts back
    on the hand.
    """
    spin = spec.add_actuator(name="spindle", trntype=mujoco.mjtTrn.mjTRN_JOINT, target="spindle")
    spin.set_to_velocity(kv=0.02)
    spin.forcelimited = True
    spin.forcerange[:] = [-SPIN, SPIN]
    gear = [0, 0, 0, 0, 0, 1]
    drive = spec.add_actuator(
        name="drive", trntype=mujoco.mjtTrn.mjTRN_SITE, target="thread0", refsite="driver", gear=gear
    )
    drive.set_to_velocity(kv=0.0)
    drive.forcelimited = True
    drive.forcerange[:] = [-TORQUE, LOOSENING]
    magnet = spec.add_actuator(name="magnet", trntype=mujoco.mjtTrn.mjTRN_BODY, target="bit")
    magnet.set_to_adhesion(gain=MAGNET)
    magnet.ctrllimited = True
    magnet.ctrlrange[:] = [0.0, 1.0]
