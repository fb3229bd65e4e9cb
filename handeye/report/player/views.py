"""Where a scene is looked at from, and the lamp that lights it for people."""

from typing import Any, Final

import numpy as np

from handeye.core.pose import Array
from handeye.report.player.packing import rounded

ROOM: Final = "room"
"""The view that a page begins with."""
_CALLED: Final = {"studio": ROOM}
"""Cameras of scenes that have another name here."""
_ORDER: Final = (ROOM, "hand", "pump", "work", "belt", "tv")
_TOOL: Final = "tool"
"""Site of a scene where its hand is."""
_BESIDE: Final = np.array([0.30, 0.38, 0.36])
"""From the hand to who looks at it, m."""
_FINGERS: Final = 0.8
"""Where its fingers are, from the wrist to the tool centre point."""
_LENS: Final = 37.0
"""Angle of view where no camera says it, degrees."""
_LAMP: Final = np.array([1.05, -0.65, 1.3])
"""From the middle of a scene to its lamp, over the scene's size: high, in front, on the left of who looks in."""


def views(model: Any) -> list[dict[str, Any]]:
    """The views of a scene, each with its name, `eye` and `at` (m) and angle (degrees).

    With a `body`, eye and point are counted from where that is, along the axes of the world.
    """
    found = [_camera(model, number) for number in range(model.ncam)]
    if not any(view["name"] == ROOM for view in found):
        found.append(_overview(model))
    found += [
        _hand(model, site) for site in range(model.nsite) if model.site(site).name.split("/")[-1] == _TOOL
    ]
    rank = {name: number for number, name in enumerate(_ORDER)}
    return sorted(found, key=lambda view: rank.get(view["name"], len(rank)))


def lamp(model: Any) -> dict[str, list[float]]:
    """Where the lamp is, and the point that it lights, m."""
    middle = np.array(model.stat.center)
    return {"eye": rounded(middle + model.stat.extent * _LAMP), "at": rounded(middle * [1, 1, 0])}


def _camera(model: Any, number: int) -> dict[str, Any]:
    """The view of a camera of the scene."""
    name, eye = model.camera(number).name, model.cam_pos0[number]
    forward = -model.cam_mat0[number].reshape(3, 3)[:, 2]
    at = eye + _distance(model, eye, forward) * forward
    return _view(_CALLED.get(name, name), eye, at, float(model.cam_fovy[number]))


def _distance(model: Any, eye: Array, forward: Array) -> float:
    """How far along its line of sight a camera looks: to the height of the middle of the scene."""
    drop = eye[2] - model.stat.center[2]
    return float(-drop / forward[2]) if drop > 0 and forward[2] < -0.1 else float(model.stat.extent)


def _overview(model: Any) -> dict[str, Any]:
    """A view of all of a scene that has no camera for it."""
    middle = np.array(model.stat.center)
    return _view(ROOM, middle + model.stat.extent * np.array([1.2, 0.7, 0.8]), middle, _LENS)


def _hand(model: Any, site: int) -> dict[str, Any]:
    """The view that goes with the hand, which points down where it works."""
    body = model.site_bodyid[site]
    at = np.array([0.0, 0.0, -_FINGERS * np.linalg.norm(model.site_pos[site])])
    return {**_view("hand", _BESIDE + at, at, _LENS), "body": model.body(body).name}


def _view(name: str, eye: Array, at: Array, angle: float) -> dict[str, Any]:
    return {"name": name, "eye": rounded(eye), "at": rounded(at), "angle": round(angle, 3)}
