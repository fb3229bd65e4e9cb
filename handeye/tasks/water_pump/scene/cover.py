"""Adds the gasket, and the top with its rotor."""

import math
from collections.abc import Sequence

import mujoco

from handeye.tasks.stanford_cell.dimensions import Dimensions, Point, dimensions, web_centre
from handeye.tasks.stanford_cell.shapes import Bore, Shaper, body_inertia
from handeye.tasks.water_pump.scene import solids
from handeye.tasks.water_pump.scene.fixtures import add_gasket_stand, add_top_stand
from handeye.tasks.water_pump.world.pump_world import PumpWorld


def add_gasket(shaper: Shaper, world: PumpWorld) -> None:
    """Add the gasket on its stand. The gasket is a rigid sheet, which rests on a land at every screw."""
    d = dimensions()
    (x, y), turn, thick = d.all("gasket_stand.grasp"), d("standard.yaw"), d("gasket.thickness")
    fixture = add_gasket_stand(shaper, world)
    body = fixture.stand(
        shaper, "gasket", x + web_centre(), y, d("gasket_stand.height"), turn, world.parts["gasket"]
    )
    # The contacts need a mass greater than a sheet's; the moments are those of this mass, spread over the outline.
    body_inertia(body, d("gasket.mass"), (0.03, 0.0, thick / 2), (4e-5, 8e-5, 1.2e-4))
    lands, bores = shaper.group(body, "lands"), shaper.group(body, "bores")
    for number, (px, py) in enumerate(world.drilled("gasket")):
        end = int(px > web_centre())  # 0 beside large hole 1, 1 beside large hole 2
        hole = Bore(radius=d("gasket.screw_hole_radius"), outer=d.all("gasket.sheet")[end], height=thick)
        shaper.ring(bores, f"gasket_hole_{end + 1}", hole, (px, py, 0.0), lambda _: "bore")
        shaper.hole(body, f"gasket_hole{number}", (px, py, thick), hole.radius)
        shaper.ball(lands, "gasket_land", thick / 2, (px, py, thick / 2))
    half = d("gasket.web") / 2
    low, high = (web_centre() - half, -0.011, 0.0), (web_centre() + half, 0.011, thick)
    shaper.box(body, "wall", low, high, name="gasket_web")
    shaper.look(body, "gasket", "gasket", solids.gasket(world.screws))


def add_top(shaper: Shaper, world: PumpWorld) -> None:
    """Add the top on its stand: a flange with clearance holes, a hub with two flats that the fingers grip, and
    the rotor."""
    d = dimensions()
    (x, y), turn, flange = d.all("top_stand.grasp"), d("standard.yaw"), d("top.flange")
    fixture = add_top_stand(shaper, world)
    body = fixture.stand(shaper, "top", x, y, d("top_stand.height"), turn, world.parts["top"])
    moments = [world.part_mass * value for value in (1e-3, 1.6e-3, 2.3e-3)]
    body_inertia(body, d("top.mass") * world.part_mass, d.all("top.mass_centre"), moments)
    _add_flange(shaper, body, d, world.drilled("top"))
    hub, across, height = d("top.hub_length") / 2, d("top.hub_flats") / 2, d("top.hub_height")
    shaper.box(body, "hub", (-hub, -across, flange), (hub, across, flange + height), name="hub")
    block = solids.extruded(solids.rectangle(-hub, -across, hub, across, 0.002), flange, flange + height)
    shaper.look(body, "flange", "top", solids.flange(world.screws))
    shaper.look(body, "hub", "top", solids.surface(block))
    _add_rotor(shaper, body, d)


def _add_flange(shaper: Shaper, body: mujoco.MjsBody, d: Dimensions, holes: Sequence[Point]) -> None:
    flange = d("top.flange")
    hole = Bore(
        radius=d("top.screw_hole_radius"), outer=0.0095, height=flange,
        above=d("top.chamfer_above"), below=d("top.chamfer_below"),
    )  # fmt: skip
    lands, bores = shaper.group(body, "lands"), shaper.group(body, "bores")
    for number, (x, y) in enumerate(holes):
        shaper.ring(bores, "top_hole", hole, (x, y, 0.0), lambda _: "bore")
        shaper.hole(body, f"top_hole{number}", (x, y, flange), hole.radius)
        shaper.box(body, "seat", (x - 0.007, y - 0.007, 0.0), (x + 0.007, y + 0.007, flange))
        shaper.box(lands, "top_land", (x - 0.008, y - 0.008, 0.0), (x + 0.008, y + 0.008, 0.006))
    x2 = d("base.large_hole_2.x")
    shaper.cylinder(body, "pierced", d("base.casting.chamber_diameter") / 2, (0, 0, 0), (0, 0, flange))
    shaper.cylinder(body, "pierced", d("base.casting.inlet_diameter") / 2, (x2, 0, 0), (x2, 0, flange))


def _add_rotor(shaper: Shaper, top: mujoco.MjsBody, d: Dimensions) -> None:
    """Add the rotor on the hub, with shaft, crank arm and crank pin. At the start, the crank pin is not above
    any screw hole."""
    body = top.add_body(name="rotor", pos=[0.0, 0.0, d("top.flange") + d("top.hub_height")])
    body_inertia(body, d("rotor.mass"), (0.0, 0.0, 0.01), (5e-5, 5e-5, 5e-5))
    body.add_joint(
        name="rotor", type=mujoco.mjtJoint.mjJNT_HINGE, axis=[0, 0, 1], armature=2e-4, damping=1e-3,
        frictionloss=d("rotor.friction"), solref_friction=[0.004, 1.0],
        solimp_friction=[0.99, 0.999, 0.001, 0.5, 2.0],
    )  # fmt: skip
    radius, arm = d("rotor.crank_radius"), d("rotor.arm_height")
    pin = d("rotor.crank_diameter") / 2
    end = arm + d("rotor.crank_height")
    shaper.cylinder(body, "crank", pin, (-radius, 0, arm), (-radius, 0, end), name="crank")
    bar = solids.hull(solids.disc(0.011), solids.disc(0.0075, -radius))
    shaper.look(body, "crank_bar", "steel", solids.surface(solids.extruded(bar, arm - 0.006, arm)))
    shaper.cylinder(body, "look", pin, (-radius, 0, arm), (-radius, 0, end), "brass", "crank_pin")
    shaper.cylinder(body, "look", 0.0063, (0, 0, 0), (0, 0, arm + 0.004), "steel", "shaft")
    collar = math.hypot(0.010, 0.004)
    shaper.cylinder(body, "look", collar, (0, 0, 0), (0, 0, 0.006), "brass", "collar")


def add_merging(spec: mujoco.MjSpec) -> None:
    """Add welds that are open at first. To save computing time, the cell closes the welds when screws clamp the parts
    together.
    """
    for part in ("top", "gasket"):
        weld = spec.add_equality(
            name=f"merge_{part}", type=mujoco.mjtEq.mjEQ_WELD, objtype=mujoco.mjtObj.mjOBJ_BODY,
            name1="base", name2=part, active=False,
            solref=[0.004, 1.0], solimp=[0.99, 0.999, 0.0001, 0.5, 2.0],
        )  # fmt: skip
        weld.data[10] = 1.0
