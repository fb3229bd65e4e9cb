"""What belongs to the computer, for people: reels of magnetic tape at the cabinets, and a teletype."""

import math
from typing import Final

from manifold3d import Manifold  # type: ignore[import-not-found]  # stubs, but no marker

from handeye.tasks.water_pump.dimensions import dimensions
from handeye.tasks.water_pump.scene import solids
from handeye.tasks.water_pump.scene.room import cabinet
from handeye.tasks.water_pump.scene.shapes import Shaper, Vector

_REEL: Final = 0.100
"""Radius of a reel, m."""
_TELETYPE: Final = (-1.70, -0.55)
"""Where the teletype stands, m."""
_TURN: Final = [math.cos(math.radians(-5)), 0.0, 0.0, math.sin(math.radians(-5))]
"""How it is turned: towards people's lamp, for faces that are nearly in line with its light are full of specks."""


def add_reels(shaper: Shaper) -> None:
    """Two tape drives: a pair of reels in the upper panels of two cabinets, one nearly full, and the heads below."""
    body = shaper.spec.worldbody
    for drive in (0, 1):
        (left, front, _), (right, _, top) = cabinet(drive)
        middle, z = (left + right) / 2, top - 0.45
        for side, tape in ((-1, 0.085), (1, 0.060)):
            _add_reel(
                shaper, f"{2 * drive + (side + 1) // 2}", (middle + side * 0.128, front + 0.006, z), tape
            )
        low, high = (middle - 0.05, front, z - 0.19), (middle + 0.05, front + 0.02, z - 0.135)
        shaper.box(body, "scenery", low, high, "steel", f"tape_heads{drive}")


def _add_reel(shaper: Shaper, number: str, at: Vector, tape: float) -> None:
    """A reel with its axis along y, on a deck at `at`, with tape to a radius (m)."""
    body, (x, y, z) = shaper.spec.worldbody, at
    shaper.cylinder(body, "scenery", tape, (x, y, z), (x, y + 0.012, z), "tape", f"tape{number}")
    shaper.cylinder(body, "scenery", 0.024, (x, y, z), (x, y + 0.024, z), "black", f"tape_hub{number}")
    shaper.scenery(body, "tape_reel", "reel", _flange(), (x, y + 0.012, z)).name = f"tape_reel{number}"


def _flange() -> solids.Surface:
    """The front flange of a reel, with three windows, its axis along y."""
    disc = solids.disc(_REEL)
    for k in range(3):
        angle = 2 * math.pi * k / 3 + 0.5
        disc -= solids.disc(0.030, 0.060 * math.cos(angle), 0.060 * math.sin(angle), 24)
    return solids.surface(solids.extruded(disc, 0.0, 0.003).rotate((-90.0, 0.0, 0.0)))


def add_teletype(shaper: Shaper) -> None:
    """A teletype on its stand, with keyboard, platen and paper, and a punch for paper tape; it looks along its x."""
    place = (*_TELETYPE, -dimensions()("table.height"))
    body = shaper.spec.worldbody.add_body(name="teletype", pos=place, quat=_TURN)
    shaper.scenery(body, "teletype_case", "case", _case())
    shaper.scenery(body, "teletype_keys", "black", _keys())
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
    """The case of a teletype, its keyboard sloping down along x."""
    profile = [
        (-0.22, 0.60),
        (0.30, 0.60),
        (0.30, 0.655),
        (0.12, 0.70),
        (0.06, 0.80),
        (-0.16, 0.82),
        (-0.22, 0.79),
    ]
    return solids.surface(solids.prism(profile, -0.26, 0.20))


def _keys() -> solids.Surface:
    """Four rows of keys on the slope of the keyboard."""
    key = solids.extruded(solids.disc(0.0075, segments=8), 0.0, 0.012)
    return solids.surface(
        Manifold.compose(
            [
                key.translate((0.285 - 0.04 * row, -0.22 + 0.028 * place + 0.007 * row, 0.655 + 0.010 * row))
                for row in range(4)
                for place in range(13)
            ]
        )
    )
