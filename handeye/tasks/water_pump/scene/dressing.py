"""Adds furniture and details that appear only in photographs: tape reels, teletype, clock, boom cables and bevels.

These objects touch nothing, have no mass, and are in a geom group that the television camera does not see.
"""

import math
from itertools import product
from typing import Final

import numpy as np
from manifold3d import Manifold  # type: ignore[import-not-found]  # stubs, but no marker

from handeye.cell.looks import BOX, PLAIN, SEEN
from handeye.cell.posed import TURNS
from handeye.core.pose import Array
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.stanford_cell.dimensions import dimensions
from handeye.tasks.stanford_cell.shapes import Shaper, Vector
from handeye.tasks.water_pump.scene import solids
from handeye.tasks.water_pump.scene.room import LEFT, cabinet
from handeye.tasks.water_pump.scene.textures import add_textures

_MATERIALS: Final = {
    "case": (0.70, 0.66, 0.55, 0.25),
    "paper": (0.90, 0.89, 0.84, 0.0),
    "tape": (0.20, 0.13, 0.09, 0.3),
    "reel": (0.78, 0.78, 0.76, 0.4),
}  # red, green, blue, and gloss


def dress(shaper: Shaper) -> None:
    """Add the furniture for photographs to a scene."""
    for name, (*rgb, gloss) in _MATERIALS.items():
        shaper.spec.add_material(name=name, rgba=[*rgb, 1.0], specular=gloss, shininess=gloss)
    add_textures(shaper.spec)
    add_reels(shaper)
    add_teletype(shaper)
    add_clock(shaper)
    add_boom_cables(shaper)
    add_bevels(shaper)


_REEL_RADIUS_M: Final = 0.100
_TELETYPE_PLACE_M: Final = (-1.70, -0.55)
_TURN: Final = [math.cos(math.radians(-5)), 0.0, 0.0, math.sin(math.radians(-5))]
"""Quaternion that turns the furniture towards the lamp that lights the photographs. Without this turn, some faces
would be nearly parallel to the light and look speckled.
"""


def add_reels(shaper: Shaper) -> None:
    """Add the fronts of two tape drives. Each drive has two reels (one of them is nearly full), and heads below the
    reels.
    """
    body = shaper.spec.worldbody
    for drive in (0, 1):
        (left, front, _), (right, _, top) = cabinet(drive)
        middle, z = (left + right) / 2, top - 0.45
        for side, tape in ((-1, 0.085), (1, 0.060)):
            number, at = 2 * drive + (side + 1) // 2, (middle + side * 0.128, front + 0.006, z)
            _add_reel(shaper, number, at, tape)
        low, high = (middle - 0.05, front, z - 0.19), (middle + 0.05, front + 0.02, z - 0.135)
        shaper.box(body, "scenery", low, high, "steel", f"tape_heads{drive}")


def _add_reel(shaper: Shaper, number: int, at: Vector, tape: float) -> None:
    """Add a reel to the front of a tape drive. The middle of the reel's back is at `at` (m), and its axis is along y.
    The tape on the reel has the radius `tape` (m).
    """
    body, (x, y, z) = shaper.spec.worldbody, at
    shaper.cylinder(body, "scenery", tape, (x, y, z), (x, y + 0.012, z), "tape", f"tape{number}")
    shaper.cylinder(body, "scenery", 0.024, (x, y, z), (x, y + 0.024, z), "black", f"tape_hub{number}")
    reel = shaper.look(body, "tape_reel", "reel", _flange(), (x, y + 0.012, z), style="scenery")
    reel.name = f"tape_reel{number}"


def _flange() -> solids.Surface:
    """Return the front flange of a reel. The flange has three windows, and its axis is along y."""
    disc = solids.disc(_REEL_RADIUS_M)
    for k in range(3):
        angle = 2 * math.pi * k / 3 + 0.5
        disc -= solids.disc(0.030, 0.060 * math.cos(angle), 0.060 * math.sin(angle), 24)
    return solids.surface(solids.extruded(disc, 0.0, 0.003).rotate((-90.0, 0.0, 0.0)))


def add_teletype(shaper: Shaper) -> None:
    """Add a teletype on its stand, with keyboard, platen, paper and a paper-tape punch. The front faces along
    the x axis of the teletype's frame.
    """
    place = (*_TELETYPE_PLACE_M, -dimensions()("table.height"))
    body = shaper.spec.worldbody.add_body(name="teletype", pos=place, quat=_TURN)
    shaper.look(body, "teletype_case", "case", _case(), style="scenery")
    shaper.look(body, "teletype_keys", "black", _keys(), style="scenery")
    for name, low, high, material in (
        ("teletype_stand", (-0.15, -0.20, 0.02), (0.12, 0.16, 0.60), "case"),
        ("teletype_foot", (-0.22, -0.24, 0.0), (0.22, 0.20, 0.03), "iron"),
        ("tape_punch", (-0.14, 0.20, 0.62), (0.14, 0.33, 0.74), "case"),
        ("printout", (-0.05, -0.18, 0.80), (-0.042, 0.12, 1.00), "paper"),
    ):
        shaper.box(body, "scenery", low, high, material, name)
    shaper.cylinder(body, "scenery", 0.05, (0.02, 0.27, 0.74), (0.02, 0.27, 0.765), "paper", "paper_tape")
    shaper.cylinder(body, "scenery", 0.030, (-0.01, -0.20, 0.805), (-0.01, 0.14, 0.805), "black", "platen")


def _case() -> solids.Surface:
    """Return the case of a teletype, whose keyboard slopes down along x."""
    below, keys = [(-0.22, 0.60), (0.30, 0.60), (0.30, 0.655)], [(0.12, 0.70), (0.06, 0.80)]
    return solids.surface(solids.prism([*below, *keys, (-0.16, 0.82), (-0.22, 0.79)], -0.26, 0.20))


def _keys() -> solids.Surface:
    """Return four rows of keys on the slope of the keyboard."""
    key = solids.extruded(solids.disc(0.0075, segments=8), 0.0, 0.012)
    keys = [
        key.translate((0.285 - 0.04 * row, -0.22 + 0.028 * place + 0.007 * row, 0.655 + 0.010 * row))
        for row in range(4)
        for place in range(13)
    ]
    return solids.surface(Manifold.compose(keys))


_X, _Y, _Z = (
    LEFT + 0.03,
    0.30,
    0.56,
)  # middle of the clock, m; as seen from the room, y is to the right and z is up
_UPRIGHT: Final = [0.5, 0.5, 0.5, 0.5]
"""Quaternion of a frame whose z axis points away from the wall and whose y axis points up."""
_HANDS: Final = {
    "hour": (43200.0, 0.085, 0.007),
    "minute": (3600.0, 0.125, 0.005),
    "second": (60.0, 0.135, 0.002),
}  # seconds of a turn, length and half the width (m)


def add_clock(shaper: Shaper) -> None:
    """Add the clock. Each hand of the clock is a body of its own, so that the hand can turn."""
    wall = shaper.spec.worldbody
    for name, radius, back, front, material in (
        ("clock_case", 0.165, -0.03, 0.008, "black"),
        ("clock_face", 0.150, 0.0, 0.012, "paper"),
        ("clock_hub", 0.008, 0.012, 0.022, "black"),
    ):
        shaper.cylinder(wall, "scenery", radius, (_X + back, _Y, _Z), (_X + front, _Y, _Z), material, name)
    for hour in range(12):
        half, angle = 0.013 if hour % 3 == 0 else 0.007, math.pi * hour / 6
        aside, up = (0.140 - half) * math.sin(angle), (0.140 - half) * math.cos(angle)
        wall.add_geom(
            shaper.style("scenery"), name=f"clock_mark{hour}", type=BOX, material="black",
            size=[0.001, 0.003, half], pos=[_X + 0.012, _Y + aside, _Z + up],
            quat=[math.cos(angle / 2), -math.sin(angle / 2), 0.0, 0.0],
        )  # fmt: skip
    for layer, (name, (_, length, half)) in enumerate(_HANDS.items()):
        z, material = 0.014 + 0.002 * layer, "red" if name == "second" else "black"
        hand = wall.add_body(name=f"{name}_hand", pos=[_X, _Y, _Z], quat=_UPRIGHT)
        shaper.box(hand, "scenery", (-half, -0.02, z), (half, length, z + 0.001), material, f"{name}_hand")
    for name, (period, _, _) in _HANDS.items():
        shaper.spec.add_numeric(name=f"{TURNS}{name}_hand", data=[period])


_SIDE, _MIDDLE = -0.0352, 0.020  # x and y of the cables in the boom's frame, m
_BACK, _FRONT = -1.36, -0.10  # where the cables begin and end along the boom, m


def add_boom_cables(shaper: Shaper) -> None:
    """Add three cables in clips along the boom, and the loop in which the cables hang between the end of the boom and
    the motor behind the boom.
    """
    boom = shaper.spec.body(f"{ARM}link3")
    for number, y in enumerate((_MIDDLE - 0.006, _MIDDLE, _MIDDLE + 0.006)):
        start, end = (_SIDE, y, _BACK), (_SIDE, y, _FRONT)
        shaper.cylinder(boom, "scenery", 0.0024, start, end, "black", f"boom_cable{number}")
    for number, z in enumerate(np.linspace(_BACK + 0.05, _FRONT - 0.05, 8)):
        low, high = (-0.0385, _MIDDLE - 0.010, z - 0.006), (-0.030, _MIDDLE + 0.010, z + 0.006)
        shaper.box(boom, "scenery", low, high, "steel", f"cable_clip{number}")
    turns = np.linspace(
        0.0, math.pi, 13
    )  # angles of the loop, from the boom's side outwards and back to the motor
    way = [(0.007 * t - 0.06 * math.sin(t), 0.0, -0.06 * (1 - math.cos(t))) for t in turns]
    loop = solids.surface(solids.tube(way, 0.006))
    shaper.look(boom, "cable_loop", "black", loop, (_SIDE, _MIDDLE, _BACK), style="scenery")


BEVEL_M: Final = 0.0005
_BEVELLED: Final = ("block", "enamel", "red", "iron")  # materials of blocks, fixtures and tools


def add_bevels(shaper: Shaper) -> None:
    """Give the boxes of a scene bevelled edges, which only photographs show. The television camera still sees the
    plain boxes.
    """
    boxes = [geom for geom in shaper.spec.geoms if geom.type == BOX and geom.group == SEEN]
    for box in boxes:
        if box.material in _BEVELLED:
            half, at = box.size.copy(), box.pos.tolist()
            name = "bevelled_" + "_".join(f"{1e6 * side:.0f}" for side in half)
            look = shaper.look(box.parent, name, box.material, bevelled(half), at, style="scenery")
            look.name = box.name and f"{box.name}_bevelled"
            box.group = PLAIN


def bevelled(half: Array) -> solids.Surface:
    """Return the surface of a box that extends from -`half` to `half` (m), with bevels on all edges."""
    corners = np.array(list(product((-1.0, 1.0), repeat=3)))
    inner = np.where(np.eye(3, dtype=bool), half, half - BEVEL_M)
    return solids.surface(Manifold.hull_points((corners[:, None] * inner).reshape(-1, 3)))
