"""Adds the parts of the rail support, their pallets and fixtures, and the screwdriver to the scene of the arm."""

from math import cos, sin
from typing import Final

import mujoco
import numpy as np

from handeye.cell.looks import MESH, SEEN
from handeye.core.pose import Array
from handeye.systems.ml.support.drawing import (
    BIT,
    DISPENSER,
    DISPENSER_HEIGHT,
    DRIVER,
    DRIVER_MASS,
    FRAME,
    FRAME_MASS,
    FRAME_PALLET,
    HOLES,
    HUB,
    NEST,
    NEST_PLAY,
    PALLET,
    PIN_BORE,
    PIN_DEPTH,
    PIN_PALLET,
    PIN_PLACES,
    PINS,
    RACK,
    RACK_HEIGHT,
    RACK_LEAD,
    RACK_PLAY,
    RAIL,
    RAIL_PALLET,
    RAIL_X,
    RAILS,
    RIB,
    RIB_LEAD,
    RIB_PLAY,
    RIBS,
    ROWS,
    SADDLE,
    SADDLE_BORE,
    SADDLE_PALLET,
    SADDLES,
    SCREWS,
    STOP,
    STOP_LEAD,
    UNIT,
    WALL,
    WALL_LEAD,
    WALL_PLAY,
    Drawing,
    Lie,
    mm,
    row,
)
from handeye.tasks.stanford_cell.screws import (
    ALUMINIUM,
    CHAMFER,
    LENGTH,
    MM,
    TAP,
    TAP_DEPTH,
    Place,
    add_bit,
    add_box,
    add_hung_screw,
    add_loose,
    add_motors,
    add_pin,
    add_ring,
    add_styles,
    add_thread,
)
from handeye.tasks.stanford_cell.shapes import Bore, Shaper, body_inertia, box_moments

MIDDLE: Final = Place(0, 0)
_GRIPPED: Final = 0.4  # friction of what the hand holds


def add_support(spec: mujoco.MjSpec, drawing: Drawing) -> None:
    """Add all parts and fixtures to the scene of the arm."""
    spec.option.enableflags |= int(mujoco.mjtEnableBit.mjENBL_DIAGEXACT)  # a thread under load needs it
    spec.option.impratio = 50
    spec.geom("table").conaffinity = 9
    add_styles(spec)
    shaper = Shaper(spec=spec)
    _add_frame(shaper, drawing)
    _add_nest(shaper, drawing)
    _add_saddles(shaper, drawing)
    _add_rails(shaper, drawing)
    _add_pins(shaper, drawing)
    _add_screws(shaper, drawing)
    _add_rack(shaper, drawing)


def _part(
    shaper: Shaper, name: str, lie: Lie, z: float, mass: float, size: tuple[float, ...]
) -> mujoco.MjsBody:
    """Add a free body. The origin of the part is the middle of its underside, which is at the height `z` (mm)."""
    body = add_loose(shaper, name, lie.at, z)
    body.quat[:] = [cos(lie.turned / 2), 0, 0, sin(lie.turned / 2)]
    body_inertia(body, mass, (0, 0, size[2] / 2 * MM), box_moments(mass, [each * MM for each in size]))
    return body


def add_ridge(
    shaper: Shaper, body: mujoco.MjsBody, mesh: str, style: str, at: Place, size: tuple[float, ...], lead: float,
    low: float, *, across: bool = False,
) -> None:  # fmt: skip
    """Add a bar along x. If `across` is True, add it along y instead. The long upper edges of the bar are bevelled by
    `lead` (mm).
    """
    long, wide, high = (each * MM for each in size)
    if shaper.spec.mesh(mesh) is None:
        profile = [(wide / 2, 0), (wide / 2, high - lead * MM), (wide / 2 - lead * MM, high)]
        corners = [(x, side * y, z) for x in (-long / 2, long / 2) for side in (-1, 1) for y, z in profile]
        points: Array = np.array(corners)
        shaper.convex(mesh, points[:, [1, 0, 2]] if across else points)
    place = (at.x * MM, at.y * MM, low * MM)
    geom = body.add_geom(shaper.style(style), type=MESH, meshname=mesh, pos=place, group=SEEN)
    geom.material = "enamel" if style == "fixed" else "iron"


def _add_frame(shaper: Shaper, drawing: Drawing) -> None:
    pallet = drawing.fixture("frame_pallet", FRAME_PALLET)
    body = _part(shaper, "frame", drawing.lie("frame", pallet), 0, FRAME_MASS, FRAME)
    long, wide, high = FRAME
    add_box(shaper, body, "base", MIDDLE, FRAME, 0, "iron")
    add_box(shaper, body, "face", MIDDLE, (long, wide, 10), high - 10)
    thick = (RIBS[1] - RIBS[0]) * UNIT - SADDLE[1] - 2 * RIB_PLAY
    for y in RIBS:
        add_ridge(shaper, body, "rib", "rib", mm(0, y), (RIB[0], thick, RIB[1]), RIB_LEAD, high)
    away = RAIL[0] / 2 + WALL_PLAY + WALL[0] / 2
    for side in (-1, 1):
        for way in (-1, 1):
            at = Place(side * RAIL_X * UNIT + way * away, 0)
            add_ridge(shaper, body, "wall", "rib", at, (RAIL[1], *WALL), WALL_LEAD, high, across=True)
    for number, (x, y) in enumerate(PIN_PLACES):
        at = drawing.hole(f"frame.pin_{number}", mm(x, y))
        add_ring(shaper, body, "pin_hole", "bore", at, high, PIN_BORE, PIN_DEPTH)
        add_box(shaper, body, "bore", at, (12, 12, 6), high - PIN_DEPTH - 6)
    for number in range(SCREWS):
        at = drawing.hole(f"frame.tap_{number}", _screw_place(number))
        add_ring(shaper, body, "tap", "tap", at, high, TAP, TAP_DEPTH)
        add_thread(shaper, body, number, at, high)


def _screw_place(number: int) -> Place:
    """Return the place of a screw in the frame. Each saddle has two screws."""
    return mm((-1, 1)[number % 2] * HOLES, ROWS[number // 2])


def _add_nest(shaper: Shaper, drawing: Drawing) -> None:
    nest = shaper.spec.worldbody.add_body(name="nest")
    at, (thick, high) = drawing.fixture("nest", NEST), STOP
    long, wide, _ = FRAME
    for side in (-1, 1):
        for way in (-1, 1):
            across = Place(at.x + side * (long / 2 + NEST_PLAY + thick / 2), at.y + way * 60)
            add_ridge(shaper, nest, "stop_y", "fixed", across, (20, thick, high), STOP_LEAD, 0, across=True)
            along = Place(at.x + way * 30, at.y + side * (wide / 2 + NEST_PLAY + thick / 2))
            add_ridge(shaper, nest, "stop_x", "fixed", along, (20, thick, high), STOP_LEAD, 0)


def _add_saddles(shaper: Shaper, drawing: Drawing) -> None:
    off = drawing.fixture("saddle_pallet", (0, 0))
    mass = ALUMINIUM * (np.prod(SADDLE) + np.prod(HUB)) * MM**3
    for number, name in enumerate(SADDLES):
        at = mm(*row(SADDLE_PALLET, number))
        lie = drawing.lie(name, Place(at.x + off.x, at.y + off.y))
        body = _part(shaper, name, lie, 0, float(mass), (SADDLE[0], SADDLE[1], 14))
        add_box(shaper, body, "plate", MIDDLE, SADDLE, 0, "plate")
        add_box(shaper, body, "plate", MIDDLE, HUB, SADDLE[2], "plate").friction[0] = _GRIPPED
        for side in (0, 1):
            x = (-1, 1)[side] * HOLES * UNIT
            at = drawing.hole(f"{name}.bore_{side}", Place(x, 0))
            add_ring(
                shaper, body, "bore", "bore", at, SADDLE[2], SADDLE_BORE, SADDLE[2], below=CHAMFER, outer=9
            )
            add_box(shaper, body, "seat", at, (16, 16, SADDLE[2]), 0)  # flat, unlike a ring
            body.add_site(
                name=f"bore{2 * number + side}", pos=[at.x * MM, at.y * MM, SADDLE[2] * MM], group=5
            )


def _add_rails(shaper: Shaper, drawing: Drawing) -> None:
    off = drawing.fixture("rail_pallet", (0, 0))
    for number, name in enumerate(RAILS):
        at = mm(*row(RAIL_PALLET, number))
        lie = drawing.lie(name, Place(at.x + off.x, at.y + off.y))
        body = _part(shaper, name, lie, 0, float(ALUMINIUM * np.prod(RAIL) * MM**3), RAIL)
        add_box(shaper, body, "plate", MIDDLE, RAIL, 0, "steel").friction[0] = _GRIPPED


def _add_pins(shaper: Shaper, drawing: Drawing) -> None:
    """Add the pins in their pallet. The origin of a pin is its lower end."""
    off, pallet = drawing.fixture("pin_pallet", (0, 0)), shaper.spec.worldbody.add_body(name="pin_pallet")
    ends = []
    for number, name in enumerate(PINS):
        x, y = mm(*row(PIN_PALLET, number))
        at = Place(x + off.x, y + off.y)
        add_ring(shaper, pallet, "pin_hole", "bore", at, PALLET, PIN_BORE, PIN_DEPTH)
        add_pin(shaper, add_loose(shaper, name, drawing.lie(name, at).at, PALLET - PIN_DEPTH))
        ends.append(at)
    middle = Place((ends[0].x + ends[-1].x) / 2, ends[0].y)
    size = abs(ends[-1].x - ends[0].x) + 26, 26
    add_box(shaper, pallet, "fixed", middle, (*size, PALLET - PIN_DEPTH), 0)
    add_box(shaper, pallet, "look", middle, (*size, PALLET), 0, "enamel")


def _add_screws(shaper: Shaper, drawing: Drawing) -> None:
    off, dispenser = drawing.fixture("dispenser", (0, 0)), shaper.spec.worldbody.add_body(name="dispenser")
    add_box(shaper, shaper.spec.worldbody, "fixed", Place(300, 200), (500, 200, 20), -1020)
    places = [mm(*row(DISPENSER, number)) for number in range(SCREWS)]
    for number, (x, y) in enumerate(places):
        add_hung_screw(shaper, dispenser, number, Place(x + off.x, y + off.y), DISPENSER_HEIGHT)
    middle = Place((places[0].x + places[-1].x) / 2 + off.x, places[0].y + off.y)
    size = places[-1].x - places[0].x + 26, 26
    add_box(shaper, dispenser, "fixed", middle, (*size, DISPENSER_HEIGHT - LENGTH - 2), 0)
    add_box(shaper, dispenser, "look", middle, (*size, DISPENSER_HEIGHT), 0, "enamel")


def _add_rack(shaper: Shaper, drawing: Drawing) -> None:
    """Add the screwdriver and its rack. The rack has a square guide, and posts under the corners of the screwdriver's
    block.
    """
    at, (wide, high), rack = (
        drawing.fixture("rack", RACK),
        DRIVER,
        shaper.spec.worldbody.add_body(name="rack"),
    )
    for across in (-1, 1):
        for along in (-1, 1):
            corner = Place(at.x + across * 12, at.y + along * 12)
            add_box(shaper, rack, "fixed", corner, (4, 4, RACK_HEIGHT), 0, "enamel")
    near = wide / 2 + RACK_PLAY
    guide = Bore(
        radius=near * MM, outer=(near + RACK_LEAD + 2) * MM, height=0.02, above=RACK_LEAD * MM, sectors=4
    )
    place = (at.x * MM, at.y * MM, (RACK_HEIGHT - 10) * MM)
    for wedge in shaper.ring(rack, "guide", guide, place, lambda _: "fixed"):
        wedge.group, wedge.material = SEEN, "enamel"
    body = _part(
        shaper, "driver", drawing.lie("driver", at), RACK_HEIGHT, DRIVER_MASS - 0.03, (wide, wide, high)
    )
    body.add_site(name="driver", group=5)
    add_box(shaper, body, "driver", MIDDLE, (wide, wide, high), 0, "brass")
    shaper.cylinder(body, "look", 0.006, (0, 0, -BIT * MM), (0, 0, 0), "steel").group = SEEN
    add_bit(shaper, body, -BIT)
    add_motors(shaper.spec)
