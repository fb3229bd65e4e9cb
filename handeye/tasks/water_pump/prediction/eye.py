"""How far off the base is seen: what the calibration of the camera leaves of its errors and of the arm's.

The calibration is a least-squares fit, and linear for errors as small as these: what it makes of a tenth of an inch, it
makes ten times of an inch. So its gain is worked out once for the drawing, and serves all worlds.
"""

from collections.abc import Callable, Iterator
from dataclasses import dataclass
from functools import cache
from typing import Final

import numpy as np

from handeye.arm.robots.stanford import STANFORD
from handeye.core.pose import Array, hand
from handeye.ports.camera import CLOSE_UP
from handeye.tasks.water_pump.prediction.hands import Hands
from handeye.tasks.water_pump.prediction.poses import points
from handeye.tasks.water_pump.prediction.worlds import Worlds
from handeye.tasks.water_pump.world.nominal import DRAWING, LOOKS
from handeye.vision.calibration import (
    PLACE_PRIOR,
    SCALE_PRIOR,
    SIGHT_ERROR,
    TURN_PRIOR,
    moved,
)
from handeye.vision.camera_model import View

Point = tuple[float, float, float]
_SMALL: Final = 1e-4
"""Of a parameter, in its prior, of an angle or of a place, for a derivative."""
_TRUE: Final = {
    **{f"camera.place.{axis}": PLACE_PRIOR for axis in "xyz"},
    "camera.turn.pan": TURN_PRIOR, "camera.turn.tilt": TURN_PRIOR, "camera.turn.roll": TURN_PRIOR,
    "camera.focal_length.25mm": SCALE_PRIOR, "camera.lens.25mm.ahead": PLACE_PRIOR, "camera.lens.25mm.up": PLACE_PRIOR,
    "camera.focal_length.50mm": SCALE_PRIOR, "camera.lens.50mm.ahead": PLACE_PRIOR, "camera.lens.50mm.up": PLACE_PRIOR,
}  # fmt: skip
"""Quantities that the fit has parameters for, in their order, and the unit of each parameter."""


def seen_off(worlds: Worlds, hands: Hands, holes: Array) -> Array:
    """By how much holes of the base, shape (holes, 3), m, W, are seen off, as the arm reads; shape (n, holes, 2)."""
    wobble = (
        worlds.noise(2 * (len(LOOKS) + 1)).reshape(len(worlds), -1, 2)
        * worlds["camera.pot_noise"][:, None, None]
    )
    fit = _fit()
    told = np.stack([_shown(worlds, hands, *look) for look in _lamps()], axis=1)
    true = worlds.each(*_TRUE) / np.array([*_TRUE.values()])
    x = true @ fit.keeps.T + np.einsum("psk,nsk->np", fit.lamps, told)
    x += np.einsum("plk,nlk->np", fit.wobbles, wobble[:, :-1])
    aim = DRAWING.aim(holes.mean(axis=0), CLOSE_UP)
    found = [_found_by(aim, hole) for hole in holes]
    return np.asarray(
        np.stack([(x - true) @ by_x.T + wobble[:, -1] @ by_aim.T for by_x, by_aim in found], axis=1)
    )


def _lamps() -> Iterator[tuple[Point, float]]:
    """Places at which the lamp is shown, and the angle of the hand there."""
    for look in LOOKS:
        for place in look.places:
            yield place, look.hand_angle


def _shown(worlds: Worlds, hands: Hands, place: Point, angle: float) -> Array:
    """By how much the lamp is off from where the arm says, m, shape (n, 3)."""
    lamp = np.array(STANFORD.hand.lamp)
    R = hand(0, 0, 0, angle, np.pi / 2, 0)[:3, :3]
    x, y, z = (np.array(place) - R @ lamp).tolist()
    true = points(
        hands.at(hand(x, y, z, angle, np.pi / 2, 0)),
        lamp + worlds.each(*(f"hand.lamp.{axis}" for axis in "xyz")),
    )
    return np.asarray(true - np.array(place))


@dataclass(frozen=True, slots=True, kw_only=True)
class _Fit:
    """What the fit's parameters follow from."""

    keeps: Array
    """True parameters, shape (parameters, parameters)."""
    lamps: Array
    """Lamps that are off, shape (parameters, sightings, 3), 1/m."""
    wobbles: Array
    """Pan and tilt that read wrong at each look, shape (parameters, looks, 2), 1/rad."""


@cache
def _fit() -> _Fit:
    """Solve the normal equations of the fit for the drawing."""
    sights = [
        _sight(look.lens, DRAWING.aim(look.at, look.lens), place) for look in LOOKS for place in look.places
    ]
    by_x, by_aim, by_place = (np.stack([sight[k] for sight in sights]) for k in range(3))
    J = by_x.reshape(-1, len(_TRUE))
    solved = np.linalg.solve(J.T @ J + np.eye(len(_TRUE)), J.T).reshape(len(_TRUE), len(sights), 2)
    turned = np.einsum("psr,srk->psk", solved, by_aim)
    look = np.array([number for number, look in enumerate(LOOKS) for _ in look.places])
    return _Fit(
        keeps=np.einsum("psr,srq->pq", solved, by_x),
        lamps=np.einsum("psr,srk->psk", solved, by_place),
        wobbles=np.stack([turned[:, look == number].sum(axis=1) for number in range(len(LOOKS))], axis=1),
    )


def _sight(lens: float, aim: tuple[float, float], point: Point) -> tuple[Array, Array, Array]:
    """Derivatives of how far a sight misses, in its sigma, by parameters, pan and tilt, and the point."""
    view, here = DRAWING.view(lens, *aim), np.array(point)
    scale = float(np.linalg.norm(here - view.X_WC[:3, 3])) / view.focal / SIGHT_ERROR
    return (
        _derivative(lambda x: _view(x, lens, aim).project(here)[0] * scale, np.zeros(len(_TRUE))),
        _derivative(lambda turn: DRAWING.view(lens, aim[0] + turn[0], aim[1] + turn[1]).project(here)[0] * scale,
                    np.zeros(2)),
        _derivative(lambda p: view.project(p)[0] * scale, here),
    )  # fmt: skip


def _found_by(aim: tuple[float, float], hole: Array) -> tuple[Array, Array]:
    """Derivatives of where a hole is found, x and y, by parameters and by pan and tilt."""
    uv = DRAWING.view(CLOSE_UP, *aim).project(hole)
    return (
        _derivative(lambda x: _view(x, CLOSE_UP, aim).back_project(uv, hole[2])[0, :2], np.zeros(len(_TRUE))),
        _derivative(
            lambda turn: DRAWING.view(CLOSE_UP, aim[0] + turn[0], aim[1] + turn[1]).back_project(uv, hole[2])[
                0, :2
            ],
            np.zeros(2),
        ),
    )


def _view(x: Array, lens: float, aim: tuple[float, float]) -> View:
    return moved(DRAWING, x).view(lens, *aim)


def _derivative(function: Callable[[Array], Array], at: Array) -> Array:
    """By central differences, shape (figures, arguments)."""
    steps = np.eye(len(at)) * _SMALL
    return np.stack([(function(at + h) - function(at - h)) / (2 * _SMALL) for h in steps], axis=-1)
