"""Findings on the cell around a pump. The pump may be assembled or taken apart. Every object must be at rest, and
every part must be present once and unaltered.
"""

import copy
from collections.abc import Sequence
from typing import Any, Final

import msgspec
import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.mechanism import Mechanism
from handeye.cell.threads import Thread, Threads, holes_of
from handeye.cell.truth import Truth
from handeye.core.errors import InvalidInput
from handeye.judge.as_drawn import altered, told
from handeye.judge.finding import Finding, Findings, at_least, at_most
from handeye.judge.measured import SettledState, deg, mm, tilt
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.water_pump.clamping import WELDS, Clamping, ClampingState, lands_of
from handeye.tasks.water_pump.referee import limits
from handeye.tasks.water_pump.referee.commands import commanded
from handeye.tasks.water_pump.referee.measure import PINS, deepest

PARTS: Final = ("base", "gasket", "top")

Mask = NDArray[np.bool_]


def around(measured: SettledState, holes: tuple[Thread, ...]) -> Findings:
    """Judge the positions and speeds in `measured`, one state of the cell."""
    model = measured.model
    parts = [*PARTS, *PINS, "driver", *loose_screws(holes)]
    lowest = min(measured.pose(name)[2, 3] for name in parts)
    bores, others = deepest(measured)
    in_threads = [hole.screw for hole in holes if hole.screw is not None]
    there = _parts(measured)
    arm = ~there
    there[[0, *(model.body(f"screw{screw}").id for screw in in_threads)]] = False
    return {
        "pins_tilt": _upright(measured, PINS, limits.PIN_TILT, "greatest tilt of a pin in its holder"),
        "rack_tilt": _upright(measured, ("driver",), limits.RACK_TILT, "tilt of the screwdriver in its rack"),
        "floor": at_least(lowest * 1e3, limits.FLOOR, "mm", "height of the lowest part above the table top"),
        "tray": _put_away(measured, in_threads),
        "hand": _hand(measured, parts),
        "still": _speed(measured, np.flatnonzero(there), "part"),
        "arm_still": _speed(measured, np.flatnonzero(arm), "link of the arm"),
        "overlap_bores": mm(
            bores.depth, limits.SOFT, f"deepest overlap of a shank or pin with a bore: {bores.between}"
        ),
        "overlap": mm(others.depth, limits.PENETRATION, f"deepest overlap of two solids: {others.between}"),
    }  # fmt: skip


def resting(left: SettledState, settled: SettledState, holes: tuple[Thread, ...]) -> Findings:
    """Judge whether every part stays where it was left."""
    away = np.linalg.norm(settled.data.xpos - left.data.xpos, axis=1)
    away[[left.model.body(f"screw{hole.screw}").id for hole in holes if hole.screw is not None]] = 0.0
    subject = "greatest distance that a part moves while the cell settles"
    return {"rest": _greatest(left, 1e3 * away, limits.REST, "mm", subject)}


def made(left: SettledState, truth: Truth) -> Findings:
    """Judge what does not change while a cell settles: the parts themselves, and the forces applied to them."""
    forces = np.abs(left.data.xfrc_applied).max(), np.abs(left.data.qfrc_applied).max()
    differing, driven = _altered(truth), commanded(truth)
    return {
        "as_drawn": at_most(
            len(differing), limits.ALTERED, "parts",
            "parts that differ from the drawing" + (f": {told(differing)}" if differing else ""),
        ),
        "bonds": at_most(
            _bonds(left, truth), 0, "bonds",
            "bonds (connections in the simulation) that are wrongly open, closed or strained",
        ),
        "held": at_most(max(forces), limits.FORCE, "N", "greatest external force on a part or the arm"),
        "motor": at_most(
            len(driven), 0, "motors",
            "motors that still have a command" + (f": {', '.join(driven)}" if driven else ""),
        ),
        "numbers": at_most(_not_finite(truth), 0, "numbers", "values of the simulated state that are not finite"),
    }  # fmt: skip


def loose_screws(holes: tuple[Thread, ...]) -> list[str]:
    """Return the names of the screws that are in no thread."""
    in_threads = {thread.screw for thread in holes}
    return [f"screw{k}" for k in range(len(holes)) if k not in in_threads]


def _altered(truth: Truth) -> dict[str, list[str]]:
    """Return the names of the parts that differ from the design. For each part, list in what ways it differs. The
    friction and drives of the arm are left out, because they change during work.
    """
    model = truth.model
    found = altered(model, _as_it_is_to_be(truth), np.ones(model.nbody, bool))
    return {
        part: left
        for part, kinds in found.items()
        if (left := [kind for kind in kinds if not (part.startswith(ARM) and kind in ("friction", "drive"))])
    }


def _as_it_is_to_be(truth: Truth) -> mujoco.MjModel:
    """Return the scene of the design, except for two kinds of quantities: those that devices may change, and those
    that another finding judges. These quantities have their present values.
    """
    model, scene, holes = truth.model, copy.deepcopy(truth.drawn), holes_of(truth)
    (threads,) = (part for part in truth.mechanisms if isinstance(part, Threads))
    threads.write(holes, scene)
    for hole, thread in enumerate(holes):
        carrier, turn = model.body(f"carrier{hole}").id, model.joint(f"thread_turn{hole}").dofadr[0]
        scene.dof_frictionloss[turn] = model.dof_frictionloss[turn]  # `screws_clamp`, `_strain` and `_hold`
        if thread.screw is not None:  # `screws_place` and `screws_lean`
            scene.body_pos[carrier], scene.body_quat[carrier] = (
                model.body_pos[carrier],
                model.body_quat[carrier],
            )
    rotor = model.joint("rotor").dofadr[0]
    for figures in ("dof_frictionloss", "dof_damping", "dof_armature"):  # `rotor`
        getattr(scene, figures)[rotor] = getattr(model, figures)[rotor]
    drive = model.actuator("drive").id  # the drive is connected to one screw after another
    for figures in ("actuator_trnid", "actuator_gainprm", "actuator_biasprm"):
        getattr(scene, figures)[drive] = getattr(model, figures)[drive]
    welds = [model.equality(name).id for name in WELDS]  # positions at which the welds closed: `bonds`
    scene.eq_data[welds, :10] = model.eq_data[welds, :10]
    if _clamped(truth):  # the welds hold the layers, and the contacts of the lands are switched off
        lands = lands_of(scene)
        scene.geom_contype[lands] = scene.geom_conaffinity[lands] = 0
    return scene


def _bonds(left: SettledState, truth: Truth) -> int:
    """Count the equality constraints of the scene that are wrongly open, wrongly closed, or strained."""
    right, active = truth.drawn.eq_active0 != 0, truth.data.eq_active != 0
    welds = [truth.drawn.equality(name).id for name in WELDS]
    right[welds] = _clamped(truth)
    strained = (_strained(left, weld) for weld in welds if active[weld])
    return int((active != right).sum()) + sum(strained)


def _strained(left: SettledState, weld: int) -> bool:
    """Return True if a weld would pull its layer away from the layer's present position."""
    model, figures, R = left.model, left.model.eq_data[weld], np.zeros(9)
    X_BP = left.relative(model.body(model.eq_obj2id[weld]).name, model.body(model.eq_obj1id[weld]).name)
    mujoco.mju_quat2Mat(R, figures[6:10])
    away = np.linalg.norm(X_BP[:3, :3] @ figures[:3] + X_BP[:3, 3] - figures[3:6])
    turn = np.linalg.norm(X_BP[:3, :3] - R.reshape(3, 3)) / np.sqrt(2)  # rad, for small angles
    return not (1e3 * away <= limits.MERGED and np.degrees(turn) <= limits.MERGED_TURN)


def _not_finite(truth: Truth) -> int:
    """Count the values in the cell's state that are not finite. A mechanism in an impossible state counts as
    one value."""
    model, kind = truth.model, mujoco.mjtState.mjSTATE_INTEGRATION
    physics = np.empty(mujoco.mj_stateSize(model, kind))
    mujoco.mj_getState(model, truth.data, physics, kind)
    changed = {field for part in truth.mechanisms for field in part.changes}
    numbers = [physics, *(np.ravel(getattr(model, field)) for field in changed)]
    unsound = sum(not _sound(part, truth.states[part.name]) for part in truth.mechanisms)
    return unsound + int((~np.isfinite(np.concatenate(numbers))).sum())


def _sound(part: Mechanism[Any], state: msgspec.Struct) -> bool:
    try:
        part.check(state)
    except (InvalidInput, ValueError):
        return False
    return True


def _clamped(truth: Truth) -> bool:
    state = truth.states[Clamping.name]
    assert isinstance(state, ClampingState)
    return state.clamped


def _parts(measured: SettledState) -> Mask:
    """Return a mask of the bodies that do not belong to the arm, shape (nbody,)."""
    model = measured.model
    return np.array([not model.body(body).name.startswith(ARM) for body in range(model.nbody)])


def _upright(measured: SettledState, bodies: Sequence[str], limit_deg: float, subject: str) -> Finding:
    return deg(max(tilt(measured.pose(body)) for body in bodies), limit_deg, subject)


def _put_away(measured: SettledState, hidden: Sequence[int]) -> Finding:
    """Judge whether the hidden bodies of screws in threads are on the tray. Also judge whether every other loose body,
    such as a nut in a user's own scene, is where the drawing puts it.
    """
    drawn, joints = measured.drawn, measured.drawn.jnt_type == mujoco.mjtJoint.mjJNT_FREE
    loose = {drawn.body(body).name for body in drawn.jnt_bodyid[joints]}
    strangers = [name for name in loose - {*PARTS, *PINS, "driver"} if not name.startswith("screw")]
    strayed = {name: measured.strayed([name], [name]) for name in strangers}
    farthest = max(strayed, key=strayed.__getitem__, default="")
    if strayed and strayed[farthest] * 1e3 > limits.TRAY:
        subject = "distance of a foreign object from the place where the drawing shows it"
        return mm(strayed[farthest], limits.TRAY, f"{subject}: {farthest}")
    return mm(
        max((measured.from_site(f"screw{k}", f"park{k}") for k in hidden), default=0.0), limits.TRAY,
        "greatest distance of a hidden screw body from its place on the tray",
    )  # fmt: skip


def _speed(measured: SettledState, bodies: NDArray[np.intp], kind: str) -> Finding:
    """Judge the greatest speed of the given bodies."""
    speeds = np.zeros(measured.model.nbody)
    speeds[bodies] = [1e3 * measured.speed(int(body)) for body in bodies]
    return _greatest(measured, speeds, limits.STILL, "mm/s", f"speed of the fastest {kind}")


def _greatest(
    measured: SettledState, values: NDArray[np.float64], limit: float, unit: str, subject: str
) -> Finding:
    """Judge the greatest value among all bodies. If this value exceeds the limit, the finding names the body."""
    body = int(np.argmax(values))
    name = measured.model.body(body).name.removeprefix(ARM)
    return at_most(values[body], limit, unit, subject if values[body] <= limit else f"{subject}: {name}")


def _hand(measured: SettledState, parts: Sequence[str]) -> Finding:
    """Judge the distance of the hand from the nearest of the given parts. Shapes that are fixed to a part belong to
    that part. A distance of more than twice the limit is reported as twice the limit.
    """
    model = measured.model
    solid = (model.geom_contype | model.geom_conaffinity) != 0
    tree, arm = model.body_rootid[model.geom_bodyid], ~_parts(measured)[model.geom_bodyid]
    mine = np.isin(tree, [model.body(part).id for part in parts])
    nearest = measured.nearest(
        np.flatnonzero(arm & solid), np.flatnonzero(mine & solid), 2 * limits.HAND_CLEAR / 1e3
    )
    return at_least(nearest * 1e3, limits.HAND_CLEAR, "mm", "distance of the hand from the nearest part")
