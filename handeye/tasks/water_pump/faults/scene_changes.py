"""Changes of the scene that represent the faults of parts. A change removes a part, displaces it, or gives it a wrong
shape.
"""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Final

import numpy as np

from handeye.core.pose import rotation_z
from handeye.tasks.stanford_cell.dimensions import Point, base_top, dimensions

if TYPE_CHECKING:
    import mujoco

GONE: Final = {
    "base": (-0.15, 0.15), "gasket": (-0.15, -0.15), "top": (0.15, -0.2), "driver": (0.2, 0.2), "pin0": (0.0, 0.1),
    "pin1": (0.05, 0.1), **{f"screw{k}": (0.05 * k - 0.1, 0.05) for k in range(7)},
}  # fmt: skip
"""Positions (m) for missing parts, on the tray below the floor, where nothing can touch them."""
OVER_TRAY_M: Final = 0.12  # more than any part reaches below its origin


_CARD_HALF_M: Final = 0.08
_FOREMOST: Final = 3  # priority in a contact, higher than that of any shape in the scene
METAL: Final = ((0.004, 1.0), (0.999, 0.9999, 0.0001, 0.5, 2.0))
"""Stiffness of the end of a blocked hole. We measured that MuJoCo's default stiffness of a joint limit is too low: a
thread drives its screw straight through the limit.
"""


def as_drawn(spec: mujoco.MjSpec, _: float) -> None:
    """Change nothing: threads have no shapes in the scene; see `bad_threads`."""


def missing(part: str, spec: mujoco.MjSpec, _: float) -> None:
    x, y = GONE[part]
    spec.body(part).pos[:] = (x, y, spec.geom("tray").pos[2] + OVER_TRAY_M)


def shift(part: str, direction: Point, spec: mujoco.MjSpec, away: float) -> None:
    spec.body(part).pos[:2] += np.multiply(direction, away)


def plate_centre() -> Point:
    return dimensions()("base.plate.centre_x"), 0.0


def reverse(spec: mujoco.MjSpec, part: str, middle: Point) -> None:
    turn(spec, part, middle, yaw_of(spec, part) + math.pi)


def turn(spec: mujoco.MjSpec, part: str, middle: Point, yaw: float) -> None:
    """Turn a part about the vertical axis through its point `middle` (m). Afterwards, the yaw of the part is `yaw`
    (rad). The tilt of the part does not change.
    """
    body = spec.body(part)
    angle = yaw - yaw_of(spec, part)
    w, *vector = body.quat
    arm = np.array([*middle, 0.0])
    away = arm + 2 * np.cross(vector, np.cross(vector, arm) + w * arm)  # from the origin to that point, in W
    body.pos[:] += away - rotation_z(angle) @ away
    c, s, (x, y, z) = math.cos(angle / 2), math.sin(angle / 2), vector
    body.quat[:] = (c * w - s * z, c * x - s * y, c * y + s * x, c * z + s * w)


def yaw_of(spec: mujoco.MjSpec, part: str) -> float:
    w, _, _, z = spec.body(part).quat
    return 2 * math.atan2(z, w)


def thicken(spec: mujoco.MjSpec, factor: float) -> None:
    """Multiply the gasket's thickness by a factor."""
    gasket = spec.body("gasket")
    shapes = [*gasket.geoms, *spec.body("gasket_bores").geoms]
    for mesh in {geom.meshname for geom in shapes if geom.meshname}:
        spec.mesh(mesh).scale[2] *= factor
    for geom in shapes:
        geom.pos[2] *= factor
        if not geom.meshname:
            geom.size[2] *= factor
    for ball in spec.body("gasket_lands").geoms:
        ball.pos[2] *= factor
        ball.size[0] *= factor
    for hole in gasket.sites:
        hole.pos[2] *= factor


def tear(spec: mujoco.MjSpec, side: float) -> None:
    """Remove a square with the side `side` (m) from the gasket. The square contains a screw hole in its middle, and
    the land of this hole.
    """
    from handeye.tasks.water_pump.scene.solids import TORN_HOLE, gasket  # slow to import, and rarely needed

    vertices, triangles = gasket(sum(site.name.startswith("gasket_hole") for site in spec.sites), side)
    sheet = spec.mesh("gasket")
    sheet.uservert, sheet.userface = vertices.ravel().tolist(), triangles.ravel().tolist()
    land = spec.body("gasket_lands").geoms[TORN_HOLE]
    land.contype = land.conaffinity = 0


def slippery(shape: str, spec: mujoco.MjSpec, _: float) -> None:
    """Remove the friction of a shape in all its contacts. By default, MuJoCo would use the greater friction of
    the two shapes."""
    geom = spec.geom(shape)
    geom.friction[:], geom.priority = 0.0, _FOREMOST


def strip(hole: int, spec: mujoco.MjSpec, _: float) -> None:
    """Strip the thread of a hole, so that a screw slides and turns freely in it."""
    spec.equality(f"thread{hole}").active = False


def chip(spec: mujoco.MjSpec, high: float) -> None:
    """Put a chip under one end of the top, the end that is farther from the top's hub. Lift the top onto the chip."""
    d = dimensions()
    (x, y), stand = d.all("top_stand.grasp"), d("top_stand.height")
    chip = spec.body("top_stand").add_geom(
        spec.find_default("solid"), name="chip", type=spec.geom("hub").type, material="steel"
    )
    chip.pos[:], chip.size[:] = (x - 0.07, y, stand + high / 2), (0.008, 0.02, high / 2)
    spec.body("top").pos[2] += high


def shade(spec: mujoco.MjSpec, _: float) -> None:
    """Hang a card half way between the lamp and the base, so that the card shades one half of the base."""
    light, base = next(each for each in spec.lights if each.name == "key").pos, spec.body("base").pos
    card = spec.worldbody.add_geom(
        name="card", type=spec.geom("hub").type, contype=0, conaffinity=0, group=2, rgba=[0.2, 0.2, 0.2, 1.0]
    )
    card.pos[:] = (light + base) / 2 + (_CARD_HALF_M, 0.0, 0.0)
    card.size[:] = _CARD_HALF_M, _CARD_HALF_M, 0.0005


def thick_nose(pin: str, spec: mujoco.MjSpec, more: float) -> None:
    wide = 1 + more / dimensions()("pin.nose_radius")
    drawn = spec.mesh("pin_nose")  # which the other pin keeps
    spec.add_mesh(name=f"{pin}_nose", uservert=list(drawn.uservert), scale=[wide, wide, 1.0])
    for geom in spec.body(pin).geoms:
        if geom.meshname == "pin_nose":
            geom.meshname = f"{pin}_nose"


def thick_point(screw: str, spec: mujoco.MjSpec, more: float) -> None:
    point = next(geom for geom in spec.body(screw).geoms if geom.fromto[2] == 0.0)
    point.size[0] += more


def block(hole: int, plug_name: str, spec: mujoco.MjSpec, depth: float) -> None:
    """Fill the bottom of a hole with metal up to a depth (m) below the mouth of the hole. A screw in this hole then
    stops at the metal.
    """
    x, y, mouth = spec.site(f"base_hole{hole}").pos
    floor = base_top() - dimensions()("base.screw_holes.depth")
    plug = spec.body("base").add_geom(
        spec.find_default("face"), name=f"{plug_name}{hole}", type=spec.geom("bit").type
    )
    plug.fromto[:] = x, y, floor, x, y, mouth - depth
    plug.size[0] = dimensions()("base.screw_holes.radius")
    slide = spec.joint(f"thread_slide{hole}")
    slide.range[0], slide.solref_limit[:], slide.solimp_limit[:] = -depth, *METAL
