"""Gasket and top: off their stands, onto the pins, and where they come to lie between those."""

from typing import Final

import numpy as np

from handeye.core.pose import Array, inverse, planar
from handeye.program.motion_operations import Height, Travel
from handeye.tasks.water_pump.prediction.assembly import Assembly
from handeye.tasks.water_pump.prediction.poses import inverses, points
from handeye.tasks.water_pump.prediction.things import (
    drawn_on_stand,
    drilled,
    layer_on_stand,
    pinned,
    standing_base,
)
from handeye.tasks.water_pump.referee.limits import SOFT
from handeye.tasks.water_pump.world.dimensions import base_top, dimensions, web_centre

_SWEEPS: Final = 30
"""In which a layer finds its place between two pins; the last ones move nothing by a micrometre."""


def lay_gasket(assembly: Assembly) -> None:
    """Take the gasket by its web, and lay it on the pins."""
    web = np.array([web_centre(), 0.0, 0.0])
    off = points(layer_on_stand(assembly.worlds, "gasket"), web) - assembly.hand("GUP")[:, :3, 3]
    assembly.has_room("gasket", "GUP", off, _web_room(assembly.ways["GUP"][0].gap))
    laid = _lay(assembly, "gasket", "G", "GON", web)
    assembly.window("gasket", "GON", Travel, laid[:, 2] - base_top())


def lay_top(assembly: Assembly) -> Array:
    """Take the top by its hub, and lay it on the pins; where it comes to lie, x, y and turn, shape (n, 3)."""
    over = "TOPUP" if "TOPUP" in assembly.ways else "TOP"  # the careful program comes down from there
    off = layer_on_stand(assembly.worlds, "top")[:, :3, 3] - assembly.hand(over)[:, :3, 3]
    assembly.fits("top", over, off, dimensions()("top.hub_flats"))
    laid = _lay(assembly, "top", "TOP", "TOPON", np.zeros(3))
    assembly.window("top", "TOPON", Travel, laid[:, 2] - base_top() - dimensions()("gasket.thickness"))
    return _between_pins(assembly, "top", laid[:, [0, 1, 3]])


def save_heights(assembly: Assembly) -> None:
    """Feel the bare face of the base, and later the gasket on it, at one place."""
    bare = base_top() - _high(assembly, "FACE") - assembly.gives("FACE")
    assembly.heights |= {"BARE": bare, "LAID": bare + dimensions()("gasket.thickness")}


def feel(assembly: Assembly, operation: str, goal: str, height: float, *, way: int = 0) -> None:
    """Feel a face at a position; height: of the face in W as drawn, m."""
    assembly.window(operation, goal, Height, height - _high(assembly, goal), way=way)


def _high(assembly: Assembly, goal: str) -> Array:
    """How far the hand stands higher than it reads, m."""
    return (assembly.hands.at(assembly.planned(goal)) - assembly.planned(goal))[:, 2, 3]


def _lay(assembly: Assembly, layer: str, taken: str, put: str, grip: Array) -> Array:
    """Bring a layer to the pins: where it is laid against the base, x, y, z and turn, shape (n, 4).

    Args:
        grip: where the fingers take it, in its frame.
    """
    d = dimensions()
    X_BP = inverses(standing_base(assembly.worlds)) @ assembly.hand(put) @ _held(assembly, layer, taken, grip)
    laid = np.column_stack([X_BP[:, :3, 3], np.arctan2(X_BP[:, 1, 0], X_BP[:, 0, 0])])
    off = _off(assembly, layer, laid[:, [0, 1, 3]])[:, pinned()]
    farther = np.linalg.norm(off, axis=-1).argmax(axis=1)
    catch = d("pin.body_bevel") + d(f"{layer}.screw_hole_radius") - d("pin.body_radius")
    catch += d("top.chamfer_below") if layer == "top" else 0.0
    assembly.meets(layer, put, off[np.arange(len(off)), farther], catch)
    lies = np.linalg.norm(_off(assembly, layer, _between_pins(assembly, layer, laid[:, [0, 1, 3]])), axis=-1)
    room = d(f"{layer}.screw_hole_radius") - d("screw.shank_radius") + SOFT / 1e3
    assembly.lies(layer, put, lies.max(axis=1), room)
    return laid


def _held(assembly: Assembly, layer: str, goal: str, grip: Array) -> Array:
    """How a layer lies in the hand that has closed on it: straight, its middle between the fingers, off across them."""
    hand = assembly.hand(goal)
    off = points(inverses(hand), points(layer_on_stand(assembly.worlds, layer), grip))
    drawn = inverse(assembly.planned(goal)) @ planar(*drawn_on_stand(layer))
    X_TP = np.broadcast_to(drawn, hand.shape).copy()
    X_TP[:, :3, 3] += (off - (drawn @ [*grip, 1.0])[:3]) * (1.0, 0.0, 1.0)
    return X_TP


def _off(assembly: Assembly, layer: str, place: Array) -> Array:
    """From the holes of a layer at a place, x, y and turn, to those of the base, shape (n, 6, 2)."""
    own, turn = drilled(assembly.worlds, layer), place[:, 2:]
    x, y = own[..., 0], own[..., 1]
    there = np.stack([place[:, :1] + x - turn * y, place[:, 1:2] + y + turn * x], axis=-1)
    return drilled(assembly.worlds, "base") - there


def _between_pins(assembly: Assembly, layer: str, laid: Array) -> Array:
    """The place nearest to where a layer is laid that both pins allow: each in turn draws its hole to itself."""
    place, play, own = laid.copy(), _play(layer), drilled(assembly.worlds, layer)
    middle = own[:, pinned()].mean(axis=1)
    for _ in range(_SWEEPS):
        for hole in pinned():
            off = _off(assembly, layer, place)[:, hole]
            away = np.linalg.norm(off, axis=1, keepdims=True)
            pull = off * np.maximum(1 - play / np.maximum(away, 1e-12), 0.0) / 2
            x, y = (own[:, hole] - middle).T
            turn = (x * pull[:, 1] - y * pull[:, 0]) / (x * x + y * y)
            place[:, :2] += pull - turn[:, None] * np.column_stack([-middle[:, 1], middle[:, 0]])
            place[:, 2] += turn
    return place


def _play(layer: str) -> float:
    """How far a layer's hole may be off its tapped hole: the pin stands aside, leans, and has play in the layer, m."""
    d = dimensions()
    aside, depth = d("base.screw_holes.radius") - d("pin.nose_radius"), d("base.screw_holes.chamfer")
    height = d("top.flange") if layer == "top" else 0.0
    guide = d("pin.nose_length") - d("pin.nose_bevel") - depth
    return aside * (1 + 2 * (height + depth) / guide) + d(f"{layer}.screw_hole_radius") - d("pin.body_radius")


def _web_room(gap: float) -> tuple[float, float]:
    """Room of fingers that come down into the large holes of the gasket, along their line and across it, m."""
    d = dimensions()
    thick, half = d("hand.finger_thickness"), d("hand.finger_width") / 2
    far = d("base.large_hole_2.x") - web_centre()
    radius = (d("base.large_hole_2.diameter") + d("gasket.hole_oversize")) / 2
    outer = far + float(np.sqrt(radius**2 - half**2)) - gap / 2 - thick
    across = float(np.sqrt(radius**2 - (gap / 2 + thick - far) ** 2)) - half
    return min((gap - d("gasket.web")) / 2, outer), across
