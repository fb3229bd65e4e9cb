"""Faults after a run: changes that a person makes to a finished pump before the arm undoes its work. The arm does not
know of these changes.

The person's hand is not simulated. A part that is removed is put on the tray below the floor, where nothing touches
it. A part that is moved is placed elsewhere, at rest. Glue is modelled as a weld. To tighten a screw, the simulation
applies a torque to it.
"""

from collections.abc import Callable, Mapping
from functools import partial
from typing import Final

import mujoco
import numpy as np

from handeye.cell.physics_stepper import wake
from handeye.cell.simulated import SimulatedCell
from handeye.cell.truth import Truth
from handeye.core.pose import Array, inverse, pose
from handeye.tasks.interface import Disturbance
from handeye.tasks.stanford_cell.arm import ARM
from handeye.tasks.water_pump.faults.mishap import Scene

TIGHT_TORQUE_NM: Final = 1.5  # five times the screwdriver's torque
_TIGHTENING_S: Final = 0.5
MOVED_M: Final = 0.005  # m, away from a block
THIN_RATIO: Final = 0.6  # thickness of the replacement pin, relative to the original
TOP_ON_STAGE: Final = 7
_FINGERS: Final = (f"{ARM}finger_a", f"{ARM}finger_b")
_PARTS: Final = ("base", "gasket", "top", "pin0", "pin1", "driver")


Make = Callable[[SimulatedCell], None]


def _scene(cell: SimulatedCell) -> Scene:
    return Scene(cell.truth.model, cell.truth.data)


def _tighten(cell: SimulatedCell) -> None:
    scene = _scene(cell)
    dof = int(scene.model.joint("thread_turn0").dofadr[0])
    scene.data.qfrc_applied[dof] = -TIGHT_TORQUE_NM
    wake(scene.data, dof)
    cell.advance(_TIGHTENING_S)
    scene.data.qfrc_applied[dof] = 0.0


def _moved(way: tuple[float, float], cell: SimulatedCell) -> None:
    scene = _scene(cell)
    for part in scene.stack():
        scene.shift(part, np.array([*way, 0.0]))


def _removed(part: str, cell: SimulatedCell) -> None:
    _scene(cell).take(part)


def _demagnetize(cell: SimulatedCell) -> None:
    model = cell.truth.model
    model.actuator_gainprm[model.actuator("magnet").id] = 0.0


def _thinned(pin: str, cell: SimulatedCell) -> None:
    model = cell.truth.model
    for geom in np.flatnonzero(model.geom_bodyid == model.body(pin).id):
        thick, _, high = model.geom_size[geom]  # of a mesh: half the sizes of its bounding box
        model.geom_type[geom] = mujoco.mjtGeom.mjGEOM_CYLINDER
        model.geom_size[geom] = (THIN_RATIO * thick, high, 0.0)


def _glued(layer: str, cell: SimulatedCell) -> None:
    model, data = cell.truth.model, cell.truth.data
    weld, X_WB, X_WL = model.equality(f"merge_{layer}").id, _pose(data, "base"), _pose(data, layer)
    X_BL = inverse(X_WB) @ X_WL
    model.eq_data[weld, :3], model.eq_data[weld, 3:6] = 0.0, X_BL[:3, 3]
    mujoco.mju_mat2Quat(model.eq_data[weld, 6:10], X_BL[:3, :3].ravel())
    data.eq_active[weld] = 1


def _pose(data: mujoco.MjData, body: str) -> Array:
    return pose(data.body(body).xmat.reshape(3, 3), data.body(body).xpos)


_OF_A_PUMP: Final[Mapping[str, tuple[str, Make]]] = {
    "screw.tightened": ("A screw is tightened by hand to 1.5 N m.", _tighten),
    "pump.moved.x": (
        "The pump is moved by 5 mm along table x, away from its block.",
        partial(_moved, (MOVED_M, 0.0)),
    ),
    "pump.moved.y": (
        "The pump is moved by 5 mm along table y, away from its block.",
        partial(_moved, (0.0, -MOVED_M)),
    ),
    "driver.removed": ("The screwdriver is removed from its rack.", partial(_removed, "driver")),
    "magnet.dead": ("The magnet of the screwdriver fails.", _demagnetize),
    "pin.removed": ("A pin is removed from its holder.", partial(_removed, "pin0")),
    "pin.swapped": (
        ("A pin is replaced by a thinner pin, which has .6 times the thickness."),
        partial(_thinned, "pin1"),
    ),
}
_OF_A_STACK: Final[Mapping[str, tuple[str, Make]]] = {
    "gasket.glued": ("The gasket is glued to the base.", partial(_glued, "gasket")),
    "top.glued": ("The top is glued to the base.", partial(_glued, "top")),
    "top.removed": ("The top is removed.", partial(_removed, "top")),
    "gasket.removed": ("The gasket is removed from under the top.", partial(_removed, "gasket")),
    "stack.moved": (
        "The base is moved by 5 mm along table x, with gasket and top.",
        partial(_moved, (MOVED_M, 0.0)),
    ),
}


def disturbances() -> tuple[Disturbance, ...]:
    """Return all changes. First come the changes to a finished pump, then the changes to a pump whose top has just
    been put on.
    """
    return tuple(
        Disturbance(name=name, meaning=meaning, make=make, after=after)
        for after, those in ((None, _OF_A_PUMP), (TOP_ON_STAGE, _OF_A_STACK))
        for name, (meaning, make) in those.items()
    )


# -- their effects ------------------------------------------------------------------------------------


def bystanders(truth: Truth) -> dict[str, Array]:
    """Return the positions (m) of the parts that lie on the table or belt and are not touched by a finger. Screws are
    left out.
    """
    model, data = truth.model, truth.data
    bodies = model.geom_bodyid[data.contact.geom]
    holding = np.isin(bodies, [model.body(name).id for name in _FINGERS])
    touched = {*model.body_rootid[bodies[holding[:, ::-1]]].tolist()}
    places = {name: data.body(name).xpos.copy() for name in _PARTS if model.body(name).id not in touched}
    return {name: place for name, place in places.items() if place[2] > 0}
