"""The pump base: plate and casting, two large holes, six tapped holes with their threads."""

import math
from collections.abc import Sequence
from functools import partial

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.looks import LATENT
from handeye.core.pose import Array
from handeye.tasks.stanford_cell.dimensions import Dimensions, Point, base_top, dimensions, screw_holes
from handeye.tasks.stanford_cell.shapes import Bore, Shaper, body_inertia, box_moments
from handeye.tasks.water_pump.scene import solids
from handeye.tasks.water_pump.scene.fasteners import screw_look
from handeye.tasks.water_pump.world.pump_world import PumpWorld

_WEDGES = 24  # number of wedges around a large hole; each covers 15 degrees


def add_base(shaper: Shaper, world: PumpWorld) -> None:
    """Add the base as a free body on the belt. The threads are bodies inside the body of the base."""
    d = dimensions()
    body = shaper.spec.worldbody.add_body(
        name="base",
        pos=[world.base.x, world.base.y, d("belt.height")],
        quat=[math.cos(world.base.yaw / 2), 0.0, 0.0, math.sin(world.base.yaw / 2)],
    )
    body.add_freejoint(name="base")
    mass = (d("base.casting.mass") + d("base.plate.mass")) * world.part_mass
    size = (d("base.plate.length"), d("base.plate.width"), base_top())
    body_inertia(body, mass, d.all("base.casting.mass_centre"), box_moments(mass, size))
    holes = world.drilled("base")
    x, length, width = d("base.plate.centre_x"), d("base.plate.length"), d("base.plate.width")
    low, high = (x - length / 2, -width / 2, 0.0), (x + length / 2, width / 2, d("base.plate.thickness"))
    shaper.box(body, "solid", low, high, name="plate")
    _add_casting(shaper, body, d, holes)
    _add_looks(shaper, body, world.screws)
    lands, bores = shaper.group(body, "lands"), shaper.group(body, "bores")
    for number, (x, y) in enumerate(holes):
        shaper.box(
            lands, "base_land", (x - 0.008, y - 0.008, base_top() - 0.010), (x + 0.008, y + 0.008, base_top())
        )
        _add_tapped_hole(shaper, body, bores, d, number, (x, y))


def _add_casting(shaper: Shaper, body: mujoco.MjsBody, d: Dimensions, holes: Sequence[Point]) -> None:
    """Add walls of solid metal around the large holes. A wedge that contains a tapped hole collides only with
    the hand and the driver, so that a screw can enter the hole.
    """
    floor, top = d("base.plate.thickness"), base_top()
    x2 = d("base.large_hole_2.x")
    bores = (
        ("wall_1", 0.0, d("base.large_hole_1.diameter"), d("base.casting.chamber_diameter")),
        ("wall_2", x2, d("base.large_hole_2.diameter"), d("base.casting.inlet_diameter")),
    )
    reach = d("base.screw_holes.radius") + d("base.screw_holes.chamfer")
    for mesh, x, inner, outer in bores:
        wall = Bore(radius=inner / 2, outer=outer / 2, height=top - floor, sectors=_WEDGES)

        def style(angle: float, x: float = x) -> str:
            return "pierced" if any(_in_wedge(angle, hx - x, hy, reach) for hx, hy in holes) else "face"

        shaper.ring(body, mesh, wall, (x, 0.0, floor), style)
    depth = top - d("base.large_hole_1.depth")
    shaper.cylinder(body, "face", bores[0][2] * 0.51, (0, 0, floor), (0, 0, depth), name="floor_1")
    x0, y0, x1, y1 = d.all("base.casting.spout")
    shaper.box(body, "wall", (x0, y0, floor), (x1, y1, top), name="spout")


def _in_wedge(angle: float, x: float, y: float, reach: float) -> bool:
    """Return True if a hole cuts into the wedge at `angle` (rad). The hole is at `x` and `y` from the axis of the ring
    (m), and its radius is `reach` (m).
    """
    away = abs(math.remainder(math.atan2(y, x) - angle, 2 * math.pi))
    return away < math.pi / _WEDGES + math.asin(min(1.0, reach / math.hypot(x, y)))


def _add_looks(shaper: Shaper, body: mujoco.MjsBody, screws: int) -> None:
    painted = solids.painted(solids.casting(screws), partial(_colour, screw_holes(screws)))
    for colour, surface in painted.items():
        shaper.look(body, f"casting_{colour}", colour, surface)
    shaper.look(body, "base_plate", "plate", solids.plate())
    d = dimensions()  # the bottom of the through hole gets the colour of its oily wall
    x, floor = d("base.large_hole_2.x"), d("base.plate.thickness")
    radius = d("base.large_hole_2.diameter") / 2
    shaper.cylinder(body, "look", radius, (x, 0, floor), (x, 0, floor + 2e-4), "hole", "floor_2")


def _colour(holes: Sequence[Point], middles: Array, normals: Array) -> NDArray[np.str_]:
    """Return the names of the colours on the base's surface. The face has the colour of machined metal, and the rest
    has the colour of cast metal. The insides of holes are dark, because they are oily and not machined.
    """
    d = dimensions()
    x2 = d("base.large_hole_2.x")
    rims = [(0.0, 0.0, d("base.large_hole_1.diameter") / 2), (x2, 0.0, d("base.large_hole_2.diameter") / 2)]
    tap = d("base.screw_holes.radius") + d("base.screw_holes.chamfer")
    rims += [(x, y, tap) for x, y in holes]
    inside = np.zeros(len(middles), bool)
    for x, y, radius in rims:
        inside |= np.hypot(middles[:, 0] - x, middles[:, 1] - y) < radius + 1e-6
    up = (normals[:, 2] > 0.99) & (middles[:, 2] > base_top() - 1e-6)
    return np.where(inside, "hole", np.where(up, "machined", "cast"))


def _add_tapped_hole(
    shaper: Shaper, body: mujoco.MjsBody, bores: mujoco.MjsBody, d: Dimensions, number: int, at: Point
) -> None:  # fmt: skip
    """Add the bore and the thread.

    The thread is a carrier body. Its frame is the frame of the screw in the thread, with the origin at the screw's
    point. The carrier's slide and its rotation are coupled by the pitch of the thread. Head and shank touch nothing
    until the cell engages a screw. Nevertheless, head and shank are compiled with the widest contact bits, because
    contact bits can be narrowed at run time but not widened.
    """
    top, depth, (x, y) = base_top(), d("base.screw_holes.depth"), at
    tap = Bore(
        radius=d("base.screw_holes.radius"), outer=d("base.screw_holes.land"), height=depth,
        above=d("base.screw_holes.chamfer"),
    )  # fmt: skip
    shaper.ring(bores, "tap", tap, (x, y, top - depth), lambda _: "tap")
    shaper.hole(body, f"base_hole{number}", (x, y, top), tap.radius)
    carrier = body.add_body(name=f"carrier{number}", pos=[x, y, top])
    carrier.gravcomp = (
        1.0  # without weight, an empty thread does not sink; a sinking one would keep the base moving
    )
    body_inertia(carrier, 0.005, (0.0, 0.0, 0.0), (1e-7, 1e-7, 1e-7))
    carrier.add_joint(shaper.style("thread_slide"), name=f"thread_slide{number}")
    carrier.add_joint(shaper.style("thread_turn"), name=f"thread_turn{number}")
    carrier.add_site(name=f"thread{number}", group=5)
    length, height = d("screw.length"), d("screw.head_height")
    head = shaper.cylinder(
        carrier, "head", d("screw.head_radius"), (0, 0, length), (0, 0, length + height), name=f"head{number}"
    )
    head.density = 0.0
    shaper.cylinder(
        carrier, "threaded", d("screw.shank_radius"), (0, 0, d("screw.point_length")), (0, 0, length),
        name=f"shank{number}",
    )  # fmt: skip
    head.rgba[3] = 0.0  # other geoms show what it looks like
    for geom in screw_look(shaper, carrier):
        geom.group = LATENT  # until a screw is engaged
    equality = shaper.spec.add_equality(
        name=f"thread{number}", type=mujoco.mjtEq.mjEQ_JOINT,
        name1=f"thread_slide{number}", name2=f"thread_turn{number}", solref=[0.004, 1.0],
    )  # fmt: skip
    # measured: with MuJoCo's default impedance, a screw under load makes two more turns without sinking deeper
    equality.solimp[:3] = [0.999, 0.9999, 0.0001]
    equality.data[:5] = [0.0, d("screw.pitch") / (2 * math.pi), 0.0, 0.0, 0.0]
