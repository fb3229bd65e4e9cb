"""Defines what the stepper can show in a run of a plan: sensor readings, and the state of the executor."""

import math
from typing import Final

import numpy as np

from handeye.core.pose import Array, Pose, hand_angles, yaw
from handeye.core.record import Vector3
from handeye.core.units import DEGREE, INCH, OUNCE_FORCE
from handeye.debugger.view_records import (
    ErrorView,
    HandView,
    JointView,
    PartPose,
    PartShown,
    PictureShown,
    PositionView,
    SearchView,
)
from handeye.debugger.views import last_picture
from handeye.program.diagnosis.cause_text import error_sentence
from handeye.program.events import GuardTripped
from handeye.program.world_model import planned_pose
from handeye.runs.runner import Runner
from handeye.runs.system import Topics

# -- by the sensors -------------------------------------------------------------------------------------


def _joints(runner: Runner) -> tuple[JointView, ...]:
    unit = {"revolute": ("deg", DEGREE), "prismatic": ("in", INCH)}
    return tuple(
        JointView(name=joint.name, value=_round(q / unit[joint.kind][1]), unit=unit[joint.kind][0])
        for joint, q in zip(runner.context.arm.joints, runner.context.drive.sensed.q, strict=True)
    )


def _hand(runner: Runner) -> HandView:
    X_WT = runner.context.drive.hand()
    return HandView(at_in=_inches(X_WT[:3, 3]), angles_deg=_three(np.array(hand_angles(X_WT)) / DEGREE))


def _force(runner: Runner) -> Vector3 | None:
    """Return the force (oz) at which a guard stopped the hand in this servo period, or None if no guard stopped it."""
    tripped = next((event for event in reversed(runner.events) if isinstance(event, GuardTripped)), None)
    if tripped is None or tripped.time != runner.time:
        return None
    return _three(-runner.context.drive.state.wrench[:3] / OUNCE_FORCE)


# -- remembered -----------------------------------------------------------------------------------------


def _error(runner: Runner) -> ErrorView | None:
    fault = runner.context.state.pending
    if fault is None:
        return None
    return ErrorView(number=fault.number, sentence=error_sentence(fault.number, fault.cause))


def _search(runner: Runner) -> SearchView | None:
    search = runner.context.state.search
    if search is None:
        return None
    x, y = search.offset(runner.context.search)
    return SearchView(
        place=search.count + 1, places=search.limit, offset_in=(_round(x / INCH), _round(y / INCH))
    )


def _parts(runner: Runner) -> dict[str, PartShown]:
    world = runner.context.world
    shown = {}
    for name, part in world.parts.items():
        planned, measured = planned_pose(part), world.state.measured.get(name)
        shown[name] = PartShown(
            planned=_pose(planned),
            measured=None if measured is None else _pose(measured),
            difference=None if measured is None else _difference(measured, planned),
        )
    return shown


def _pose(X_WP: Pose) -> PartPose:
    return PartPose(at_in=_inches(X_WP[:3, 3]), yaw_deg=_round(yaw(X_WP) / DEGREE))


def _difference(measured: Pose, planned: Pose) -> PartPose:
    turn = math.remainder(yaw(measured) - yaw(planned), 2 * math.pi)
    return PartPose(at_in=_inches(measured[:3, 3] - planned[:3, 3]), yaw_deg=_round(turn / DEGREE))


def _positions(runner: Runner) -> dict[str, PositionView]:
    world = runner.context.world
    shown = {}
    for name, taught in world.positions.items():
        position = world.state.moved.get(name, taught)
        x, y, z = _inches(np.array(position.at[:3]))
        o, a, t = _three(np.array(position.at[3:]) / DEGREE)
        shown[name] = PositionView(at=(x, y, z, o, a, t), of=position.of, moved=name in world.state.moved)
    return shown


def _picture(runner: Runner) -> PictureShown | None:
    name = last_picture(runner)
    return None if name is None else PictureShown(name=name, file=None)


# -- figures --------------------------------------------------------------------------------------------


def _round(x: float) -> float:
    return round(float(x), 4) + 0.0


def _three(values: Array) -> Vector3:
    x, y, z = (_round(value) for value in values)
    return x, y, z


def _inches(p: Array) -> Vector3:
    return _three(p / INCH)


def _differences(table: dict[str, Array]) -> dict[str, Vector3]:
    return {name: _inches(difference) for name, difference in sorted(table.items())}


TOPICS: Final[Topics] = {
    "time": ("time_s", lambda runner: runner.time),
    "joints": ("joints", _joints),
    "hand": ("hand", _hand),
    "force": ("force_oz", _force),
    "gap": ("gap_in", lambda runner: _round(runner.context.drive.sensed.gap / INCH)),
    "switches": ("switches", lambda runner: tuple(map(bool, runner.context.drive.sensed.touch))),
    "error": ("error", _error),
    "saved": ("saved_in", lambda runner: _differences(runner.context.state.saved)),
    "restored": ("restored_in", lambda runner: _differences(runner.context.state.restored)),
    "search": ("search", _search),
    "parts": ("parts", _parts),
    "picture": ("picture", _picture),
    "positions": ("positions", _positions),
}
