"""Adds base, plate, pins, screws, their fixtures and the screwdriver of arm 2 to the scene of the gantries."""

from math import cos, pi, sin, sqrt
from typing import Final

import mujoco
import numpy as np

from handeye.cell.looks import LATENT, SEEN
from handeye.core.pose import Array
from handeye.systems.sigma.prco.drawing import (
    BASE,
    BIT,
    CHAMFER,
    DISPENSER_BORE,
    DISPENSER_HEIGHT,
    HEAD,
    HEAD_HEIGHT,
    HOLDER_BORE,
    HOLDER_HEIGHT,
    HUB,
    LAND,
    LENGTH,
    PIN_BORE,
    PIN_DEPTH,
    PIN_LENGTH,
    PIN_POINT,
    PIN_RADIUS,
    PIN_TAPER,
    PITCH,
    PLATE,
    PLATE_PIN_BORE,
    PLAY,
    POINT,
    POINT_LENGTH,
    RING,
    SCREW_BORE,
    SHANK,
    STAND_HEIGHT,
    TAP,
    TAP_DEPTH,
    Place,
    Pump,
    dispenser_places,
    holder_places,
)
from handeye.tasks.stanford_cell.shapes import Bore, Shaper, body_inertia, box_moments

MM: Final = 0.001
DRIVER_MASS: Final = 0.3  # kg, taken from the palm: both hands weigh the same
TORQUE: Final = 0.32  # N m at which the clutch slips, as of the pump's screwdriver
SPIN: Final = (
    0.01  # N m on a loose screw: less than friction between bit and head, which do not slide in a slot
)
LOOSENING: Final = 0.8  # N m with which it loosens
MAGNET: Final = 2.0  # N
_REACH: Final = 0.001  # m from the face at which the magnet still draws a head
_POLES: Final = 6
_SECTORS: Final = 8  # wedges of a hole: they give a round pin 8 % more play in some directions, and save time
_POLE: Final = 5e-4  # m
_STEEL: Final = 7800.0
_ALUMINIUM: Final = 2700.0

# Contact bits: 1 the machine, the board and fixtures; 2 what only the arms touch; 4 bores; 8 loose parts; 16 seats of
# heads; 32 the face of the base; 64 tapped holes.
_STYLES: Final[dict[str, tuple[int, int]]] = {
    "fixed": (1, 9),
    "base": (1, 1),
    "face": (32, 0),
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


def add_pump(spec: mujoco.MjSpec, pump: Pump) -> None:
    """Add everything to the scene of the gantries."""
    spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_DIAGEXACT)  # a thread under load needs it
    spec.option.impratio = 50
    _add_styles(spec)
    shaper = Shaper(spec=spec)
    for geom in spec.geoms:
        if geom.classname.name in ("arm", "finger"):
            geom.contype = 3
    spec.geom("board").conaffinity = 9
    _add_base(shaper, pump)
    _add_plate(shaper, pump)
    _add_pins(shaper, pump)
    _add_screws(shaper, pump)
    _add_driver(shaper)


def _add_styles(spec: mujoco.MjSpec) -> None:
    """Add the default classes of shapes, which differ in what they touch, and the colours."""
    for name, (contype, conaffinity) in _STYLES.items():
        style = spec.find_default(name) or spec.add_default(name, spec.default)
        geom = style.geom
        geom.contype, geom.conaffinity, geom.mass, geom.group = contype, conaffinity, 0.0, 3
        geom.solref[:], geom.solimp[:3] = [0.004, 1.0], [0.95, 0.99, 0.0005]
        geom.friction[:] = [0.2, 0.002, 0.0001]
        geom.condim = 3
        if name in ("head", "seat", "bit"):
            geom.solimp[:3] = [0.99, 0.999, 0.0001]
        if name in ("face", "plate"):
            geom.solimp[:3] = [0.999, 0.9999, 0.0001]
    spec.find_default("head").geom.condim = 4
    for name in ("head", "threaded"):
        spec.find_default(name).geom.priority = 1
    bit = spec.find_default("bit").geom
    bit.condim, bit.priority, bit.friction[:] = 4, 2, [0.8, 0.003, 0.0001]
    for name, rgba in _COLOURS.items():
        spec.add_material(name=name, rgba=list(rgba), specular=0.3, shininess=0.4)


def _box(
    shaper: Shaper,
    body: mujoco.MjsBody,
    style: str,
    at: Place,
    size: tuple[float, ...],
    low: float,
    colour: str = "",
) -> mujoco.MjsGeom:
    """Add a box around a place, between the height `low` and the height of its size over that (mm)."""
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


def _ring(
    shaper: Shaper, body: mujoco.MjsBody, mesh: str, style: str, at: Place, top: float, radius: float, depth: float,
    *, below: float = 0.0, outer: float = LAND,
) -> None:  # fmt: skip
    """Add a hole whose mouth is at the height `top` (mm), and show it."""
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
    _disc(shaper, body, radius + CHAMFER, mouth, "steel", 1e-4)
    _disc(shaper, body, radius, mouth, "dark", 2e-4)


def _disc(
    shaper: Shaper, body: mujoco.MjsBody, radius: float, at: tuple[float, ...], colour: str, z: float
) -> None:
    x, y, top = at
    shaper.cylinder(body, "look", radius * MM, (x, y, top - 1e-4), (x, y, top + z), colour).group = SEEN


def _add_base(shaper: Shaper, pump: Pump) -> None:
    """Add the base with its holes, loose in a nest of four stops."""
    nest, (length, width, height) = pump.nest, BASE
    stops = shaper.spec.worldbody.add_body(name="nest", pos=[nest.x * MM, nest.y * MM, 0])
    for sign in (-1, 1):
        for side in (-1, 1):
            across = Place(sign * (length / 2 + PLAY + 4), side * 20)
            _box(shaper, stops, "fixed", across, (8, 12, 12), 0, "enamel")
            along = Place(side * 50, sign * (width / 2 + PLAY + 4))
            _box(shaper, stops, "fixed", along, (12, 8, 12), 0, "enamel")
    body = _loose(shaper, "base", nest, 0)
    mass = _ALUMINIUM * length * width * height * MM**3
    body_inertia(body, mass, (0, 0, height / 2 * MM), box_moments(mass, [each * MM for each in BASE]))
    _box(shaper, body, "base", Place(0, 0), BASE, 0, "iron")
    _box(shaper, body, "face", Place(0, 0), (length, width, 10), height - 10)
    for at in pump.base_pins:
        _ring(shaper, body, "pin_hole", "bore", at, height, PIN_BORE, PIN_DEPTH)
        _box(shaper, body, "bore", at, (12, 12, 6), height - PIN_DEPTH - 6)
    for number, at in enumerate(pump.base_taps):
        _ring(shaper, body, "tap", "tap", at, height, TAP, TAP_DEPTH)
        _add_thread(shaper, body, number, at)


def _loose(shaper: Shaper, name: str, at: Place, z: float) -> mujoco.MjsBody:
    """Add a free body at a place and a height (mm)."""
    body = shaper.spec.worldbody.add_body(name=name, pos=[at.x * MM, at.y * MM, z * MM])
    body.add_freejoint(name=name)
    return body


def _add_thread(shaper: Shaper, base: mujoco.MjsBody, number: int, at: Place) -> None:
    """Add the carrier that represents a screw in its thread, as `handeye/cell/threads.py` needs it."""
    carrier = base.add_body(name=f"carrier{number}", pos=[at.x * MM, at.y * MM, BASE[2] * MM])
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
    """Add head and shank of a screw, whose origin is its point, to a body."""
    top = LENGTH + HEAD_HEIGHT
    first = shaper.cylinder(
        body, head, HEAD * MM, (0, 0, LENGTH * MM), (0, 0, top * MM), "screw", name=head_name
    )
    second = shaper.cylinder(
        body, shank, SHANK * MM, (0, 0, POINT_LENGTH * MM), (0, 0, LENGTH * MM), "screw", name=shank_name
    )
    return first, second


def _add_plate(shaper: Shaper, pump: Pump) -> None:
    """Add the plate with its hub, on its stand."""
    length, width, height = PLATE
    stand = shaper.spec.worldbody.add_body(name="stand", pos=[pump.stand.x * MM, pump.stand.y * MM, 0])
    for side in (-1, 1):
        _box(shaper, stand, "fixed", Place(side * 50, 0), (16, 60, STAND_HEIGHT), 0, "enamel")
    body = _loose(shaper, "plate", pump.stand, STAND_HEIGHT)
    sheet = _ALUMINIUM * length * width * height * MM**3
    hub = _ALUMINIUM * HUB[0] * HUB[1] * HUB[2] * MM**3
    mass = sheet + hub
    middle = (sheet * height / 2 + hub * (height + HUB[2] / 2)) / mass
    body_inertia(body, mass, (0, 0, middle * MM), box_moments(mass, (length * MM, width * MM, 0.016)))
    _box(shaper, body, "plate", Place(0, 0), PLATE, 0, "plate")
    hold = _box(shaper, body, "plate", Place(0, 0), HUB, height, "plate")
    hold.friction[0] = 0.4
    for at in pump.plate_pins:
        _ring(shaper, body, "plate_pin_hole", "bore", at, height, PLATE_PIN_BORE, height, below=CHAMFER)
    for number, at in enumerate(pump.plate_bores):
        _ring(shaper, body, "plate_bore", "bore", at, height, SCREW_BORE, height, below=CHAMFER)
        _box(shaper, body, "seat", at, (16, 16, height), 0)  # flat, unlike a ring; only heads touch it
        body.add_site(name=f"plate_bore{number}", pos=[at.x * MM, at.y * MM, height * MM], group=5)


def _add_pins(shaper: Shaper, pump: Pump) -> None:
    """Add the pins in their holder. The origin of a pin is its lower end."""
    x, y = pump.holder
    holder = shaper.spec.worldbody.add_body(name="holder")
    for number, at in enumerate(holder_places(pump)):
        _ring(shaper, holder, "holder_hole", "bore", at, HOLDER_HEIGHT, HOLDER_BORE, PIN_DEPTH)
        body = _loose(shaper, f"pin_{number + 1}", at, HOLDER_HEIGHT - PIN_DEPTH)
        _add_pin(shaper, body)
    _box(shaper, holder, "fixed", Place(x, y), (80, 26, HOLDER_HEIGHT - PIN_DEPTH), 0)
    _box(shaper, holder, "look", Place(x, y), (80, 26, HOLDER_HEIGHT), 0, "enamel")


def _add_pin(shaper: Shaper, body: mujoco.MjsBody) -> None:
    name, rows = "pin", [(PIN_POINT, 0.0), (PIN_RADIUS, PIN_TAPER), (PIN_RADIUS, PIN_LENGTH)]
    if shaper.spec.mesh(name) is None:
        shaper.convex(name, _turned(rows))
    geom = body.add_geom(
        shaper.style("pin"), type=mujoco.mjtGeom.mjGEOM_MESH, meshname=name, group=SEEN, density=_STEEL
    )
    geom.mass = float("nan")
    geom.material = "pin"


def _turned(rows: list[tuple[float, float]], sides: int = 16) -> Array:
    """Return the corners of a turned body, m, from its rings of (radius, height), mm."""
    angles = 2 * pi * np.arange(sides) / sides
    return (
        np.concatenate(
            [np.column_stack((r * np.cos(angles), r * np.sin(angles), np.full(sides, z))) for r, z in rows]
        )
        * MM
    )


def _add_screws(shaper: Shaper, pump: Pump) -> None:
    """Add the screws in their dispenser, and the tray for the loose bodies of screws in threads, out of sight."""
    (x, y), top = pump.dispenser, DISPENSER_HEIGHT
    dispenser = shaper.spec.worldbody.add_body(name="dispenser")
    _box(shaper, shaper.spec.worldbody, "fixed", Place(300, 200), (400, 200, 20), -1020)
    for number, at in enumerate(dispenser_places(pump)):
        _ring(shaper, dispenser, "dispenser_hole", "bore", at, top, DISPENSER_BORE, 10, outer=LAND)
        _box(shaper, dispenser, "seat", at, (16, 16, 10), top - 10)
        name = f"screw{number}"
        body = _loose(shaper, name, at, top - LENGTH)
        _screw_shapes(shaper, body, "head", "shank", f"screw_head{number}", "")[0].group = SEEN
        for geom in body.geoms:
            geom.group, geom.mass, geom.density = SEEN, float("nan"), _STEEL
        point = shaper.cylinder(body, "shank", POINT * MM, (0, 0, 0), (0, 0, POINT_LENGTH * MM), "screw")
        point.group, point.mass, point.density = SEEN, float("nan"), _STEEL
        park = (0.15 + 0.04 * number, 0.2, -1.0)
        shaper.spec.worldbody.add_site(name=f"park{number}", pos=park, group=5)
    _box(shaper, dispenser, "fixed", Place(x, y), (130, 26, top - LENGTH - 2), 0)
    _box(shaper, dispenser, "look", Place(x, y), (130, 26, top), 0, "enamel")


def _add_driver(shaper: Shaper) -> None:
    """Mount the screwdriver between the fingers of arm 2, below the wrist, with its motors."""
    spec = shaper.spec
    hand = spec.body("hand_2")
    hand.mass -= DRIVER_MASS
    body = hand.add_body(name="driver", pos=[0, 0, BIT * MM], gravcomp=1)
    body_inertia(body, DRIVER_MASS - 0.03, (0, 0, 0.05), (1e-4, 1e-4, 3e-5))
    body.add_site(name="driver", group=5)
    shaper.cylinder(body, "driver", 0.0085, (0, 0, 0.025), (0, 0, 0.084), "brass").group = SEEN
    bit = body.add_body(name="bit", gravcomp=1)
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
    brass = bit.add_body(name="socket", gravcomp=1)  # the magnet holds by the face, not by the ring
    for wedge in shaper.ring(brass, "socket", ring, (0.0, 0.0, -RING * MM), lambda _: "driver"):
        wedge.group, wedge.material = SEEN, "brass"
    shaper.cylinder(bit, "driver", 0.006, (0, 0, 0.001), (0, 0, 0.030), "steel").group = SEEN
    _add_motors(spec)


def _add_motors(spec: mujoco.MjSpec) -> None:
    """Add the motor of the spindle, the drive of the threads, which acts back on the hand, and the magnet."""
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
