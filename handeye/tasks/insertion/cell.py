"""Builds the insertion bench: an arm, a pin in a holder, a plate with one hole, and a witness. The witness records for
the referee what really happened.
"""

import math
from typing import Final

import mujoco
import numpy as np

from handeye.arm.robots.stanford import STANFORD
from handeye.cell.arm import SimulatedArm
from handeye.cell.hand import SimulatedHand
from handeye.cell.looks import MESH, SEEN
from handeye.cell.physics_stepper import PhysicsStepper
from handeye.cell.simulated import SimulatedCell
from handeye.core.pose import Array
from handeye.core.resources import scenes
from handeye.core.units import INCH
from handeye.tasks.insertion.world import InsertionWorld
from handeye.tasks.stanford_cell.arm import ARM, add_arm
from handeye.tasks.stanford_cell.dimensions import PARK, base_top, dimensions, pin_seat
from handeye.tasks.stanford_cell.shapes import Bore, Shaper, add_camera

HOLE: Final = (25 * INCH, 38 * INCH)
"""Position of the hole (m) as taught to the program. A hole in the base of the pump has the same position in the
pump's cell.
"""
HOLDER: Final = (15 * INCH, 35 * INCH)
"""Position of the holder with the pin (m): as in the pump's cell."""
FACE: Final = base_top()  # height of the face around the hole, m
CORNERS: Final = 48  # corners of a section of the nose; between two corners, the nose is .005 mm slimmer
WEDGES: Final = 24
"""Number of wedges around the hole. Between two wedges, the hole is .02 mm wider. Because the nose of the pin is
round, the play of the pin grows by less: from .057 mm to at most .063 mm.
"""
PUSH: Final = "push"
"""Name of the sensor for the resultant force (N, in frame W) of all contacts between plate and pin. No device reads
the sensor.
"""
_NET_FORCE: Final = [1 << int(mujoco.mjtConDataField.mjCONDATA_FORCE), 3, 1]
"""What the sensor measures: one value, the resultant force of all contacts."""
_ON_THE_FLOOR: Final = np.array([0.5, -0.5, -0.7])  # m: place of a pin that is not in the holder
_RIM: Final = 0.070  # radius of the face around the hole, m
_METAL: Final = ("solid", "tap", "bore", "base_land", "shoulder", "nose")
"""Default classes of the MuJoCo model for the shapes whose friction varies between worlds."""


def build(world: InsertionWorld) -> mujoco.MjModel:
    """Compile the scene. All joint positions are zero. Zero is outside the limits of joint 3, so the caller must set a
    configuration before the first physics step.
    """
    spec = mujoco.MjSpec.from_file(str(scenes() / "water_pump" / "workcell.xml"))
    add_arm(spec, world)  # first, because free bodies added before the arm would shift its joints
    shaper = Shaper(spec=spec)
    for style in _METAL:
        shaper.style(style).geom.friction[0] *= world.friction["part"]
    _add_room(shaper)
    _add_plate(shaper, world)
    _add_holder(shaper, empty=world.empty)
    spec.add_sensor(
        name=PUSH, type=mujoco.mjtSensor.mjSENS_CONTACT, intprm=_NET_FORCE,
        objtype=mujoco.mjtObj.mjOBJ_BODY, objname="plate", reftype=mujoco.mjtObj.mjOBJ_BODY, refname="pin",
    )  # fmt: skip
    return spec.compile()


def _add_room(shaper: Shaper) -> None:
    d, body = dimensions(), shaper.spec.worldbody
    width, depth = d.all("table.size")
    eye, at = np.array([1.95, 1.8, 0.9]), np.array([0.54, 0.76, 0.20])
    add_camera(shaper.spec, "studio", eye, at).fovy = 33.0
    body.add_light(pos=[0.2, 0.4, 2.0], dir=[0.3, 0.4, -1.0])
    table = shaper.box(body, "solid", (0, 0, -d("table.thickness")), (width, depth, 0), "table", "table")
    table.group = SEEN
    shaper.spec.add_texture(
        name="backdrop", type=mujoco.mjtTexture.mjTEXTURE_SKYBOX, builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.38, 0.38, 0.37], rgb2=[0.16, 0.16, 0.17], width=256, height=256,
    )  # fmt: skip


def _add_plate(shaper: Shaper, world: InsertionWorld) -> None:
    """Add the plate with the hole. As on the pump's base, the pin's nose touches wedges around the hole, and the pin's
    shoulder touches a flat land.
    """
    d = dimensions()
    at = [HOLE[0] + world.plate[0], HOLE[1] + world.plate[1], 0.0]
    plate = shaper.spec.worldbody.add_body(name="plate", pos=at)
    radius, depth = d("pin.nose_radius") + world.clearance / 2, d("base.screw_holes.depth")
    hole = Bore(radius=radius, outer=_RIM, height=depth, above=world.chamfer, sectors=WEDGES)
    for wedge in shaper.ring(plate, "plate", hole, (0, 0, FACE - depth), lambda _: "tap"):
        wedge.group, wedge.material = SEEN, "machined"
    shaper.box(plate, "base_land", (-_RIM, -_RIM, FACE - 0.010), (_RIM, _RIM, FACE))
    shaper.hole(plate, "hole", (0, 0, FACE), radius)


def _add_holder(shaper: Shaper, *, empty: bool) -> None:
    """Add the pin, and a holder like the holder of the pump's pins. The pin stands in the holder or, if `empty` is
    True, lies on the floor, where the arm cannot touch it. The pin's origin is in the plane of the pin's shoulder.
    """
    d, (x, y) = dimensions(), HOLDER
    radius, chamfer, height = d("pin_holder.hole_radius"), d("pin_holder.chamfer"), d("pin_holder.height")
    hole = Bore(radius=radius, outer=0.0125, height=0.021, above=chamfer)
    holder = shaper.spec.worldbody.add_body(name="holder", pos=[x, y, 0.0])
    for wedge in shaper.ring(holder, "holder", hole, (0, 0, height - hole.height), lambda _: "bore"):
        wedge.group, wedge.material = SEEN, "enamel"
    at = _ON_THE_FLOOR if empty else in_holder()
    pin = shaper.spec.worldbody.add_body(name="pin", pos=at.tolist(), gravcomp=float(empty))
    pin.add_freejoint(name="pin")
    _add_pin(shaper, pin)


def in_holder() -> Array:
    """Return the position of the pin's origin in W (m, shape (3,)) when the pin stands in its holder."""
    d = dimensions()
    seat = pin_seat(d("pin_holder.chamfer"), d("pin_holder.hole_radius"))
    return np.array([*HOLDER, d("pin_holder.height") + seat])


def _add_pin(shaper: Shaper, body: mujoco.MjsBody) -> None:
    """Add the shapes of a pin to a body. The pin is the pump's aligning pin with a rounder nose."""
    d = dimensions()
    r, length, bevel = d("pin.nose_radius"), d("pin.nose_length"), d("pin.nose_bevel")
    nose = [(r - bevel, -length), (r, bevel - length), (r, 0.0)]
    r, length, bevel = d("pin.body_radius"), d("pin.body_length"), d("pin.body_bevel")
    shank = [(r, 0.0), (r, length - bevel), (r - bevel, length)]
    for name, style, profile, corners in (("nose", "nose", nose, CORNERS), ("body", "shoulder", shank, 16)):
        turns = 2 * math.pi * np.arange(corners) / corners
        points = np.array([(r * math.cos(a), r * math.sin(a), z) for r, z in profile for a in turns])
        mesh = shaper.convex(f"pin_{name}", points)
        geom = body.add_geom(shaper.style(style), type=MESH, meshname=mesh, group=SEEN)
        geom.material = "pin"


SEATED: Final = 2e-4
"""Greatest height of the shoulder above the face at which a pin counts as seated (m). Our choice: a hundredth of
the pin's descent.
"""


class Witness(PhysicsStepper):
    """Steps the physics, and records the contacts of pin and plate after each step."""

    def __init__(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        super().__init__(model, data)
        self._push = data.sensor(PUSH).data
        self.peak = 0.0  # greatest resultant of all contacts of pin and plate in any step so far, N
        self.first: float | None = None  # time of the first contact, s on the cell's clock
        self.seated: float | None = None  # time at which the pin was first seated, s on the cell's clock

    def _closely(self, steps: int) -> None:
        for _ in range(steps):
            mujoco.mj_step(self._model, self._data)
            self._look()

    def _look(self) -> None:
        x, y, z = self._push
        if not (x or y or z):
            return
        time = float(self._data.time)
        self.first = time if self.first is None else self.first
        self.peak = max(self.peak, math.hypot(x, y, z))
        if self.seated is None and shoulder(self._data) <= SEATED:
            self.seated = time


class InsertionCell(SimulatedCell):
    """A cell with a witness that records the contacts of pin and plate."""

    def __init__(self, world: InsertionWorld) -> None:
        """Build the cell of a world and switch it on."""
        model = build(world)
        data, noise = mujoco.MjData(model), world.generator("sensors")
        arm = SimulatedArm(model, data, ARM, arm=STANFORD, posture=PARK, errors=world.arm, noise=noise)
        hand = SimulatedHand(model, data, ARM, hand=STANFORD.hand, errors=world.hand, noise=noise)
        self.witness = Witness(model, data)  # for the bench; hidden from the working phase
        super().__init__(model, data, arm=arm, hand=hand, stepper=self.witness, noise=noise)


def shoulder(data: mujoco.MjData) -> float:
    """Return the height of the pin's shoulder above the face (m)."""
    return float(data.body("pin").xpos[2]) - FACE


def off_hole(data: mujoco.MjData) -> float:
    """Return the horizontal distance of the pin's origin from the axis of the hole (m)."""
    return float(np.hypot(*(data.body("pin").xpos - data.body("plate").xpos)[:2]))


def off_holder(data: mujoco.MjData) -> tuple[float, float]:
    """Return how far the pin is from its position in the holder (m), and the tilt of the pin (rad)."""
    pin = data.body("pin")
    return float(np.linalg.norm(pin.xpos - in_holder())), math.acos(min(1.0, float(pin.xmat[8])))


def tip(data: mujoco.MjData) -> Array:
    """Return the centre of the end of the pin's nose in W (m, shape (3,))."""
    pin = data.body("pin")
    return np.asarray(pin.xpos - dimensions()("pin.nose_length") * pin.xmat.reshape(3, 3)[:, 2])
