"""Adds the aligning pins in their holder and the screws in their dispenser."""

import math
from functools import cache

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.looks import MESH
from handeye.core.pose import Array
from handeye.tasks.stanford_cell.dimensions import dimensions, dispenser_places, pin_seat
from handeye.tasks.stanford_cell.shapes import Bore, Shaper, body_inertia
from handeye.tasks.water_pump.scene import solids
from handeye.tasks.water_pump.scene.fixtures import add_fixture
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.tasks.water_pump.world.stations import Station


def add_pins(shaper: Shaper, world: PumpWorld) -> None:
    """Add the holder, and a loose stepped pin in each of its holes. The origin of a pin is in the plane of its
    shoulder.
    """
    d = dimensions()
    x0, y0, x1, y1 = d.all("pin_holder.places")
    radius, chamfer, height = d("pin_holder.hole_radius"), d("pin_holder.chamfer"), d("pin_holder.height")
    hole = Bore(radius=radius, outer=0.0125, height=0.021, above=chamfer)
    fixture = add_fixture(shaper, world, Station.PIN_HOLDER, ((x0 + x1) / 2, (y0 + y1) / 2))
    places = ((x0, y0), (x1, y1))
    for number, (x, y) in enumerate(places):
        shaper.ring(fixture.body, "holder", hole, (x, y, height - hole.height), lambda _: "bore")
        _add_pin(shaper, fixture.stand(shaper, f"pin{number}", x, y, height + pin_seat(chamfer, radius)))
    low, high = (x0 - 0.02, y0 - 0.02), (x1 + 0.02, y1 + 0.02)
    shaper.box(fixture.body, "solid", (*low, 0.0), (*high, height - hole.height - 0.0005))
    block = solids.drilled((*low, *high), height, places, radius, hole.height, chamfer)
    shaper.look(fixture.body, "pin_holder", "enamel", block)


def _add_pin(shaper: Shaper, body: mujoco.MjsBody) -> None:
    d = dimensions()
    r, length, bevel = d("pin.nose_radius"), d("pin.nose_length"), d("pin.nose_bevel")
    nose = [(0.0, -length), (r - bevel, -length), (r, bevel - length), (r, 0.0), (0.0, 0.0)]
    r, length, bevel = d("pin.body_radius"), d("pin.body_length"), d("pin.body_bevel")
    shank = [(0.0, 0.0), (r, 0.0), (r, length - bevel), (r - bevel, length), (0.0, length)]
    for name, style, profile in (("pin_nose", "nose", nose), ("pin_body", "shoulder", shank)):
        if shaper.spec.mesh(name) is None:
            shaper.convex(name, solids.surface(solids.revolved(profile, 16))[0])
        geom = body.add_geom(shaper.style(style), type=MESH, meshname=name, group=2)
        geom.material = "pin"


def add_screws(shaper: Shaper, world: PumpWorld) -> None:
    """Add the dispenser and the loose screws: one screw hangs by its head in each hole of the dispenser. The origin of
    a screw is at its tip.
    """
    d = dimensions()
    height, length, (x, y) = d("dispenser.height"), d("screw.length"), d.all("dispenser.place")
    hole = Bore(radius=d("dispenser.hole_radius"), outer=0.0095, height=0.010, above=0.0015)
    fixture = add_fixture(shaper, world, Station.DISPENSER, (x, y))
    beyond = (world.screws - 6) * d("dispenser.pitch")
    low, high = (x - 0.019, y - 0.064), (x + 0.019, y + 0.064 + beyond)
    places = dispenser_places(world.screws)
    for number, (px, py) in enumerate(places):
        shaper.ring(fixture.body, "dispenser", hole, (px, py, height - hole.height), lambda _: "bore")
        shaper.box(
            fixture.body, "seat", (px - 0.008, py - 0.008, height - 0.010), (px + 0.008, py + 0.008, height)
        )
        name = f"screw{number}"
        body = fixture.stand(shaper, name, px, py, height - length, error=world.parts[name])
        _add_screw(shaper, body, number)
    shaper.box(fixture.body, "solid", (*low, 0.0), (*high, height - length - 0.002))
    block = solids.drilled((*low, *high), height, places, hole.radius, 0.02, hole.above)
    shaper.look(fixture.body, "screw_dispenser", "enamel", block)


def _add_screw(shaper: Shaper, body: mujoco.MjsBody, number: int) -> None:
    d = dimensions()
    length, height, tip = d("screw.length"), d("screw.head_height"), d("screw.point_length")
    shaper.cylinder(body, "shank", d("screw.shank_radius"), (0, 0, tip), (0, 0, length))
    shaper.cylinder(body, "shank", d("screw.point_radius"), (0, 0, 0), (0, 0, tip))
    head = f"screw_head{number}"
    shaper.cylinder(body, "head", d("screw.head_radius"), (0, 0, length), (0, 0, length + height), name=head)
    screw_look(shaper, body)
    mass, centre, moments = _screw_inertia(shaper.style("shank").geom.density)
    body_inertia(body, mass, (0.0, 0.0, centre), moments)


@cache
def _screw_inertia(density: float) -> tuple[float, float, tuple[float, float, float]]:
    """Return the mass of a screw with its thread (kg), the height of its centre of mass above its point (m),
    and its principal moments of inertia (kg m2).
    """
    volume, centre, moments = solids.volume_moments(_screw())
    across, _, along = (density * moments).tolist()  # the slot makes the two transverse ones differ by .5 %
    return density * volume, float(centre[2]), (across, across, along)


def screw_look(shaper: Shaper, body: mujoco.MjsBody) -> list[mujoco.MjsGeom]:
    """Add the visible surface of a screw: threaded shank and slotted head. The origin is at the tip of the screw."""
    return [shaper.look(body, f"screw_{name}", name, part) for name, part in _screw_surfaces().items()]


@cache
def _screw_surfaces() -> dict[str, solids.Surface]:
    """Return the surface of a screw, divided by colour."""
    top = dimensions()("screw.length") + dimensions()("screw.head_height")

    def colour(middles: Array, normals: Array) -> NDArray[np.str_]:
        slot = (abs(middles[:, 1]) < 0.00071) & (abs(middles[:, 2] - top + 0.0006) < 0.00061)
        return np.where(slot, "slot", "screw")

    return solids.painted(_screw(), colour)


@cache
def _screw() -> solids.Surface:
    """Return the surface of a screw."""
    d = dimensions()
    length, height, tip = d("screw.length"), d("screw.head_height"), d("screw.point_length")
    crest, head, pitch = d("screw.shank_radius"), d("screw.head_radius"), d("screw.pitch")
    root, bevel, top = crest - 0.0006, 0.0006, length + height
    thread = [(0.0, 0.0), (d("screw.point_radius"), 0.0), (d("screw.point_radius"), tip)]
    for k in range(math.floor((length - tip) / pitch)):
        thread += [(root, tip + k * pitch), (crest, tip + (k + 0.5) * pitch)]
    thread += [(root, length), (0.0, length)]
    cap = [(0.0, length), (head, length), (head, top - bevel), (head - bevel, top), (0.0, top)]
    slot = solids.extruded(solids.rectangle(-0.01, -0.0007, 0.01, 0.0007), top - 0.0012, top + 0.001)
    return solids.surface(solids.revolved(thread, 20) + (solids.revolved(cap) - slot))
