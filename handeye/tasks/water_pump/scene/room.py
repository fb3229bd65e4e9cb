"""Adds the surroundings: table, belt, floor, walls, lights and cameras."""

import math
from itertools import product

import mujoco
import numpy as np

from handeye.ports.camera import COLUMNS, ROWS
from handeye.tasks.stanford_cell.dimensions import dimensions
from handeye.tasks.stanford_cell.shapes import Shaper, add_camera, towards
from handeye.tasks.water_pump.world.pump_world import PumpWorld

LEFT, BACK, RIGHT, FRONT = -2.4, -2.0, 6.0, 6.0
"""Bounds of the room (m); it has walls on the left and at the back."""
TRAY = -2.0
"""Height (m) of a tray below the floor, out of sight. While a carrier in a thread represents a screw, the screw's own
body lies on this tray.
"""


Point3 = tuple[float, float, float]


def add_room(shaper: Shaper, world: PumpWorld) -> None:
    """Add the room to the scene: all that is fixed in place, except the fixtures."""
    _add_table(shaper, world)
    _add_belt(shaper, world)
    _add_building(shaper, world.screws)
    _add_computer(shaper)
    _add_tripod(shaper)
    _add_light(shaper.spec, world)
    _add_cameras(shaper.spec)


def _friction(world: PumpWorld) -> list[float]:
    return [0.25 * world.friction["table"], 0.002, 0.0001]  # assembly study


def _add_table(shaper: Shaper, world: PumpWorld) -> None:
    d = dimensions()
    body, (width, depth), thick = shaper.spec.worldbody, d.all("table.size"), d("table.thickness")
    table = shaper.box(body, "solid", (0, 0, -thick), (width, depth, 0), "table", "table")
    table.group, table.friction[:] = 2, _friction(world)
    floor, edge, leg = -d("table.height"), 0.012, 0.045
    corners = product((0.05, width - 0.05 - 2 * leg), (0.05, depth - 0.05 - 2 * leg))
    for k, (x, y) in enumerate(corners):
        shaper.box(body, "look", (x, y, floor), (x + 2 * leg, y + 2 * leg, -thick), "wood", f"table_leg{k}")
    edges = (
        (-edge, -edge, width + edge, 0), (-edge, depth, width + edge, depth + edge),
        (-edge, 0, 0, depth), (width, 0, width + edge, depth),
    )  # fmt: skip
    for k, (x0, y0, x1, y1) in enumerate(edges):
        shaper.box(body, "look", (x0, y0, -thick - 0.06), (x1, y1, -0.004), "wood", f"table_edge{k}")
    shaper.box(body, "look", (0.388, 0.134, 0.0), (0.628, 0.374, 0.1524), "iron", "riser")  # under the arm


def _add_belt(shaper: Shaper, world: PumpWorld) -> None:
    """Add the belt with its end rollers and its two side rails. The rails stay below the surface of the belt."""
    d = dimensions()
    body, depth = shaper.spec.worldbody, d.all("table.size")[1]
    (x0, x1), top = d.all("belt.x"), d("belt.height")
    radius = top / 2
    belt = shaper.box(body, "solid", (x0, radius, 0), (x1, depth - radius, top), "belt", "belt")
    belt.group, belt.friction[:] = 2, _friction(world)
    for k, y in enumerate((radius, depth - radius)):
        shaper.cylinder(body, "look", radius, (x0, y, radius), (x1, y, radius), "belt", f"belt_roller{k}")
    for side, x in enumerate((x0 - 0.008, x1)):
        low, high = (x, 0.004, 0.0), (x + 0.008, depth - 0.004, top - 0.002)
        shaper.box(body, "look", low, high, "rail", f"belt_rail{side}")
        for k, y in enumerate(np.linspace(0.1, depth - 0.1, 6)):
            start, end = (x - 0.0015, y, radius), (x + 0.0095, y, radius)
            shaper.cylinder(body, "look", 0.004, start, end, "black", f"belt_bolt{6 * side + k}")


def _add_building(shaper: Shaper, screws: int) -> None:
    d = dimensions()
    body, floor = shaper.spec.worldbody, -d("table.height")
    shaper.box(body, "look", (LEFT, BACK, floor - 0.02), (RIGHT, FRONT, floor), "floor", "floor")
    shaper.box(body, "scenery", (LEFT, BACK - 0.05, floor), (RIGHT, BACK, 3.0), "plaster", "wall0")
    shaper.box(body, "scenery", (LEFT - 0.05, BACK, floor), (LEFT, FRONT, 3.0), "plaster", "wall1")
    shaper.box(body, "scenery", (LEFT, BACK, floor), (RIGHT, BACK + 0.015, floor + 0.09), "iron", "skirting0")
    shaper.box(body, "scenery", (LEFT, BACK, floor), (LEFT + 0.015, FRONT, floor + 0.09), "iron", "skirting1")
    shaper.box(
        body, "solid", (-0.3, -0.3, TRAY - 0.02), (0.4, 0.3, TRAY), name="tray"
    )  # has room for seven screws
    for k in range(screws):
        body.add_site(name=f"park{k}", pos=[0.05 * k, 0.0, TRAY], group=5)


def cabinet(number: int) -> tuple[Point3, Point3]:
    """Return two opposite corners of a computer cabinet (m): front left bottom, and back right top."""
    left, floor = -0.85 + 0.57 * number, -dimensions()("table.height")
    return (left, -1.35, floor + 0.06), (left + 0.55, -1.35, floor + 1.75)


def _add_computer(shaper: Shaper) -> None:
    """Add three cabinets at the far wall, with rows of indicator lamps."""
    body, floor = shaper.spec.worldbody, -dimensions()("table.height")
    for k in range(3):
        (left, front, below), (right, _, top) = cabinet(k)
        shaper.box(body, "scenery", (left, -1.95, below), (right, front, top), "cabinet", f"computer{k}")
        plate = (left + 0.03, front, top - 0.10), (right - 0.03, front + 0.004, top - 0.03)
        shaper.box(body, "scenery", *plate, "red", f"computer_name_plate{k}")
        for n, z in enumerate((0.35, 0.62, 0.89)):
            panel = (left + 0.03, front, floor + z), (right - 0.03, front + 0.006, floor + z + 0.22)
            shaper.box(body, "scenery", *panel, "black", f"computer_panel{3 * k + n}")
        for row in range(3):
            for column in range(18):
                x, z = left + 0.06 + 0.025 * column, top - 0.20 - 0.05 * row
                lit = (7 * column + 5 * row + 3 * k) % 5 < 2
                lamp = (x, front, z), (x + 0.009, front + 0.006, z + 0.009)
                number = column + 18 * (row + 3 * k)
                shaper.box(body, "scenery", *lamp, "lit" if lit else "black", f"indicator_lamp{number}")


def _add_tripod(shaper: Shaper) -> None:
    """Add the body of the television camera. The body is behind the camera's mount, so that it never appears in the
    camera's own picture.
    """
    d = dimensions()
    body, floor = shaper.spec.worldbody, -d("table.height")
    x, y, z = d.all("camera.mount")
    head = body.add_body(
        name="television_camera", pos=[x, y, z], quat=towards(np.array([-0.2, -0.75, -1.35]))
    )
    shaper.box(head, "scenery", (-0.055, -0.065, 0.07), (0.055, 0.065, 0.36), "enamel")
    shaper.cylinder(head, "scenery", 0.048, (0, 0, 0.055), (0, 0, 0.07), "black")
    for side in (-1, 1):
        shaper.cylinder(head, "scenery", 0.016, (side * 0.022, 0, 0.04), (side * 0.022, 0, 0.055), "steel")
    back = y + 0.45  # leans back, to stay out of the view of `studio`
    shaper.cylinder(body, "scenery", 0.02, (x, back, 0.35), (x, y + 0.14, z + 0.20), "steel", "tripod")
    for k, angle in enumerate((0.5, 2.6, 4.7)):
        foot = (x + 0.42 * math.cos(angle), back + 0.30 * math.sin(angle), floor)
        shaper.cylinder(body, "scenery", 0.014, foot, (x, back, 0.55), "black", f"tripod_leg{k}")


def _add_light(spec: mujoco.MjSpec, world: PumpWorld) -> None:
    """Add the ambient light of the room, and one lamp that casts shadows. The lamp is at the same distance from the
    work as in the vision study (docs/studies.md).
    """
    d, light = dimensions(), world.light
    target, distance = np.array(d.all("camera.light_target")), d("camera.light_distance")
    sine, cosine = math.sin(light.zenith), math.cos(light.zenith)
    towards = np.array([sine * math.cos(light.azimuth), sine * math.sin(light.azimuth), cosine])
    spec.worldbody.add_light(
        name="key", type=mujoco.mjtLightType.mjLIGHT_SPOT, pos=(target + distance * towards).tolist(),
        dir=(-towards).tolist(), castshadow=True, cutoff=40.0, exponent=0.0, attenuation=[1, 0, 0],
        diffuse=[light.strength] * 3, specular=[0.4] * 3, ambient=[0, 0, 0],
    )  # fmt: skip
    spec.visual.headlight.ambient[:] = [light.ambient] * 3


def _add_cameras(spec: mujoco.MjSpec) -> None:
    """Add the cameras for photographs, and the television camera `tv`. At first, the television camera looks at the
    standard position; the cell can turn the camera.
    """
    d = dimensions()
    focal = d.all("camera.focal_length")[0]
    tv = add_camera(spec, "tv", np.array(d.all("camera.mount")), np.array([*d.all("standard.place"), 0.04]))
    tv.resolution[:] = [COLUMNS, ROWS]
    tv.sensor_size[:] = d.all("camera.raster")
    tv.focal_length[:] = [focal, focal]
    for name, eye, at, fovy in (
        ("studio", (2.75, 1.95, 1.35), (0.62, 0.66, 0.20), 37.0),
        ("pump", (1.02, 1.42, 0.42), (0.61, 0.965, 0.035), 25.0),
        ("work", (1.55, 1.75, 0.62), (0.58, 0.91, 0.23), 31.0),
        ("belt", (1.62, 1.35, 0.75), (1.13, 0.75, 0.03), 32.0),
    ):
        add_camera(spec, name, np.array(eye), np.array(at)).fovy = fovy
