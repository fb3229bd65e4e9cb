"""The layout of observations and actions: names, units and ranges."""

import math
from collections.abc import Mapping
from typing import Any, Final, Literal

import numpy as np
from gymnasium import spaces

from handeye.arm.model import ArmModel, constants
from handeye.core.pose import Array
from handeye.core.record import Record
from handeye.ports.camera import COLUMNS, ROWS
from handeye.ports.workcell import Sensed

ActionKind = Literal["torques", "hand"]
Observation = dict[str, Any]  # see `observation_space`
ObservationSpace = spaces.Dict

STEP: Final = 0.002
"""Greatest displacement (m) of the hand's set-point along each axis in a servo period. The speed is then .12 m/s. Our
choice.
"""
TURN: Final = 0.01
"""Greatest turn (rad) of the set-point about each axis in a servo period. The rate is then .6 rad/s. Our choice."""
SPINDLE: Final = 40.0
"""Greatest speed of the screwdriver (rad/s): twice the 190 turns a minute at which the program drives screws."""
LOAD: Final = 50.0  # greatest weight in the hand that the servo compensates, N: twice that of the pump's base
SWITCHED: Final = 0.5  # a switch of the action is on above this value

_RATE: Final = 1e3  # beyond any rate of a joint, rad/s or m/s
_FAR: Final = 1e3
"""No reading reaches this bound: neither a position (rad, m or mm), nor a force (N), nor a torque of the screwdriver
(N m).
"""
_LATE: Final = 1e6  # beyond any reading of the clock, s


class Component(Record, frozen=True, kw_only=True):
    """One component of an action. In the Box of the action space, the component is a number without unit. This number
    times `scale` is the component's value in `unit`.
    """

    name: str
    scale: float
    unit: str
    signed: bool = False  # range of the Box: -1 to 1, else 0 to 1


def components(kind: ActionKind, arm: ArmModel, *, pictures: bool) -> tuple[Component, ...]:
    """Return the components of an action, in order. If `pictures` is True, the components include the commands to the
    camera.
    """
    done = Component(name="done", scale=1.0, unit="")
    return (*_driven(kind, arm), *_hand(arm), *(_CAMERA if pictures else ()), done)


def _driven(kind: ActionKind, arm: ArmModel) -> tuple[Component, ...]:
    """Return the components that move the arm."""
    if kind == "torques":
        return tuple(
            Component(
                name=f"torque.{number}", scale=joint.effort, signed=True,
                unit="N" if joint.kind == "prismatic" else "N m",
            )
            for number, joint in enumerate(arm.joints, 1)
        )  # fmt: skip
    moves = tuple(Component(name=f"move.{axis}", scale=STEP, unit="m", signed=True) for axis in "xyz")
    turns = tuple(Component(name=f"turn.{axis}", scale=TURN, unit="rad", signed=True) for axis in "xyz")
    return (*moves, *turns, Component(name="load", scale=LOAD, unit="N"))


_CAMERA: Final = (
    Component(name="set_lens", scale=1.0, unit=""),
    Component(name="close_up", scale=1.0, unit=""),
    Component(name="set_aim", scale=1.0, unit=""),
    Component(name="pan", scale=math.pi, unit="rad", signed=True),
    Component(name="tilt", scale=math.pi, unit="rad", signed=True),
    Component(name="set_focus", scale=1.0, unit=""),
    Component(name="focus", scale=4.0, unit="1/m"),
    Component(name="hold_target", scale=1.0, unit=""),
    Component(name="look", scale=1.0, unit=""),
)
"""Commands to the television camera. `set_lens`, `set_aim` and `set_focus` send the values that follow them; `focus` is
the reciprocal of the distance. `look` asks for a picture, which arrives when the mechanism has come to rest and the
picture is digitised.
"""


def _hand(arm: ArmModel) -> tuple[Component, ...]:
    """Return the components for fingers, brakes and screwdriver."""
    return (
        Component(name="brake", scale=1.0, unit=""),
        Component(name="gap", scale=arm.hand.gap_max, unit="m"),
        Component(name="grip", scale=arm.hand.grip, unit="N"),
        Component(name="driver", scale=SPINDLE, unit="rad/s", signed=True),
        Component(name="magnet", scale=1.0, unit=""),
    )


def action_space(parts: tuple[Component, ...]) -> spaces.Box:
    """Return the action space, a Box, for actions with these components."""
    low = np.array([-1.0 if part.signed else 0.0 for part in parts])
    return spaces.Box(low=low, high=np.ones(len(parts)), dtype=np.float64)


def numbers(count: int, most: float | Array = _FAR) -> spaces.Box:
    """Return the space of `count` readings, each between -`most` and `most`."""
    high = np.broadcast_to(most, (count,))
    return spaces.Box(low=-high, high=high, dtype=np.float64)


def codes(count: int, most: int) -> spaces.Box:
    """Return the space of `count` whole numbers, each between 0 and `most`."""
    return spaces.Box(low=0, high=most, shape=(count,), dtype=np.int8)


def switches(count: int) -> spaces.MultiBinary:
    """Return the space of `count` switches."""
    return spaces.MultiBinary(count)


def clock() -> spaces.Box:
    """Return the space of the clock's reading (s), shape (1,)."""
    return spaces.Box(low=0.0, high=_LATE, shape=(1,), dtype=np.float64)


def together(readings: Mapping[str, spaces.Space[Any]]) -> ObservationSpace:
    """Return the space of observations with these readings, by name."""
    return spaces.Dict(dict(readings))


def observation_space(arm: ArmModel, *, pictures: bool) -> spaces.Dict:
    """Return the space of the observations: the readings of all ports at the end of a servo period."""
    n, effort = len(arm.joints), constants(arm).effort
    found: dict[str, spaces.Space[Any]] = {
        "q": numbers(n),
        "qd": numbers(n, _RATE),
        "torque": numbers(n, effort),
        "gap": numbers(1),
        "touch": switches(2),
        "screwdriver": numbers(1),
        "braked": switches(1),
        "clock": clock(),
    }
    if pictures:
        found["camera"] = numbers(2)
        found["picture"] = spaces.Box(low=0, high=15, shape=(ROWS, COLUMNS), dtype=np.uint8)
        found["picture_age"] = spaces.Box(low=-1.0, high=_LATE, shape=(1,), dtype=np.float64)
    return together(found)


def observation(sensed: Sensed, torque: Array) -> Observation:
    """Return the readings of a servo period as an observation. `torque` has the torques that were commanded in this
    servo period, shape (n,).
    """
    return {
        "q": sensed.q.copy(),
        "qd": sensed.qd.copy(),
        "torque": torque.copy(),
        "gap": np.array([sensed.gap]),
        "touch": np.array(sensed.touch, dtype=np.int8),
        "screwdriver": np.array([sensed.tool_torque]),
        "braked": np.array([sensed.braked], dtype=np.int8),
        "clock": np.array([sensed.time]),
    }


def named(parts: tuple[Component, ...], action: Array) -> Mapping[str, float]:
    """Return the value of each component of an action, by the component's name and in the component's unit. Values
    outside of the Box are clipped.
    """
    least = np.array([-1.0 if part.signed else 0.0 for part in parts])
    values = np.clip(action, least, 1.0)
    return {part.name: float(value) * part.scale for part, value in zip(parts, values, strict=True)}


def encoded(parts: tuple[Component, ...], values: Mapping[str, float]) -> Array:
    """Return the action with these values. Each value is in the unit of its component. Components that are left out
    are 0.
    """
    return np.array([values.get(part.name, 0.0) / part.scale for part in parts])
