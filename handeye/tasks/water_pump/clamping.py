"""Saves computing time: parts at rest sleep, and parts clamped together move as one.

*Sleep.* MuJoCo puts a group of bodies to sleep once all of them are at rest, and wakes the group when an awake body
touches it. Therefore sleep does not change how the work goes. By default, MuJoCo never lets bodies with a motor sleep.
This default would keep the driver awake. It would also keep the base awake, because the driver's motor can turn the
thread carriers in the base. In this cell, the driver and the base may sleep. The motor turns a carrier only while the
bit is on the carrier's screw head, and this contact wakes the base. A driver whose motor is switched on is woken
explicitly.

*Clamping.* Two seated screws press gasket and top on the base, and friction holds gasket and top in place. From then
on, welds hold the two layers. The contacts between the layers are switched off, because they take most of the stack's
computing time. The contacts are switched on again if fewer than two screws clamp the layers. They are also switched on
again if another body pushes a layer too hard: sideways with more than the friction force, or upwards with more than
the clamping force. This body may be the hand or the shank of a screw, for example.
"""

from typing import Final

import mujoco
import numpy as np
from numpy.typing import NDArray

from handeye.cell.contact_memo import ContactMemo
from handeye.cell.mechanism import Mechanism
from handeye.cell.physics_stepper import allow
from handeye.cell.threads import Threads
from handeye.core.pose import Array, inverse, pose
from handeye.core.record import Record

SCREWS: Final = 2
CLAMP: Final = 40.0  # N per screw: two screws hold 16 N sideways if the friction is .2. Our choice.

_MOTORED: Final = ("base", "driver")
LAYERS: Final = ("gasket", "top")
WELDS: Final = tuple(f"merge_{layer}" for layer in LAYERS)
_LANDS: Final = (64, 128)  # contact bits of the lands of gasket and top; scenes/water_pump/workcell.xml


class ClampingState(Record, frozen=True, kw_only=True):
    """Whether welds hold the layers at present."""

    clamped: bool


class Clamping(Mechanism[ClampingState]):
    """Puts resting parts of one cell to sleep, and welds its clamped layers together."""

    name = "clamping"
    kind = ClampingState
    changes = ("eq_data", "geom_contype", "geom_conaffinity")

    def __init__(
        self, model: mujoco.MjModel, data: mujoco.MjData, threads: Threads, *, allowed: bool
    ) -> None:
        """Prepare the cell. If `allowed` is False, no part sleeps and no weld holds the layers: the physics is the
        same, but the simulation is slower.
        """
        self._model, self._data, self._threads, self._allowed = model, data, threads, allowed
        self._base = model.body("base").id
        self._layers = [model.body(name).id for name in LAYERS]
        self._welds = [model.equality(name).id for name in WELDS]
        self._lands = lands_of(model)
        self._friction = float(model.geom_friction[self._lands, 0].max())
        root = model.body_rootid[model.geom_bodyid]
        self._of_layer = [root == layer for layer in self._layers]
        shanks = [model.geom(f"shank{k}").id for k in range(len(threads.holes))]
        self._foreign = ~np.isin(root, [self._base, *self._layers])
        self._foreign[shanks] = True
        self._pressing = ContactMemo(data, self._of_outsiders)
        self._bits = model.geom_contype[self._lands].copy(), model.geom_conaffinity[self._lands].copy()
        self._clamped = False
        if allowed:
            for name in _MOTORED:
                allow(model, int(model.body_treeid[model.body(name).id]))
        else:
            model.opt.enableflags &= ~int(mujoco.mjtEnableBit.mjENBL_SLEEP)

    def before(self, seconds: float) -> None:
        """Weld the layers together or separate them, depending on the present clamping force of the screws."""
        clamps = [hole.clamp for hole in self._threads.holes]
        clamped = (
            self._allowed
            and sum(clamp > CLAMP for clamp in clamps) >= SCREWS
            and not self._slips(sum(clamps))
        )
        if clamped and not self._clamped:
            self._join()
        elif self._clamped and not clamped:
            self.release(self._model, self._data)
        self._clamped = clamped

    @property
    def clamped(self) -> bool:
        """True if welds hold the layers."""
        return self._clamped

    def state(self) -> ClampingState:
        return ClampingState(clamped=self._clamped)

    def restore(self, state: ClampingState) -> None:
        self._clamped = state.clamped

    def _slips(self, clamp: float) -> bool:
        """Return True if a force on a layer exceeds the friction under a clamping force `clamp` (N), or lifts
        the layer."""
        for contacts in self._pressing.now():
            x, y, z = self._pushed(contacts)
            if np.hypot(x, y) > self._friction * clamp or z > clamp:
                return True
        return False

    def _of_outsiders(self, geoms: NDArray[np.int32]) -> list[list[tuple[int, float]]]:
        """Return the contacts of layers with bodies outside the stack: one list for each layer with such contacts.
        Each contact has a sign; the force on the layer is the contact force times this sign.
        """
        first, second = geoms.T
        touched = [
            [
                (int(contact), sign)
                for into, other, sign in (
                    (second, first, 1.0),
                    (first, second, -1.0),
                )  # the force is on the second
                for contact in np.flatnonzero(layer[into] & self._foreign[other])
            ]
            for layer in self._of_layer
        ]
        return [contacts for contacts in touched if contacts]

    def _pushed(self, contacts: list[tuple[int, float]]) -> Array:
        """Return the total force in W (N, shape (3,)) that the given contacts exert on a layer."""
        model, data, total, found = self._model, self._data, np.zeros(3), np.zeros(6)
        for contact, sign in contacts:
            mujoco.mj_contactForce(model, data, contact, found)
            total += sign * found[:3] @ data.contact.frame[contact].reshape(3, 3)
        return total

    def _join(self) -> None:
        model, data = self._model, self._data
        X_WB = pose(data.xmat[self._base].reshape(3, 3), data.xpos[self._base])
        for weld, body in zip(self._welds, self._layers, strict=True):
            X_BP = inverse(X_WB) @ pose(data.xmat[body].reshape(3, 3), data.xpos[body])
            model.eq_data[weld, :3] = 0.0
            model.eq_data[weld, 3:6] = X_BP[:3, 3]
            mujoco.mju_mat2Quat(model.eq_data[weld, 6:10], X_BP[:3, :3].ravel())
            data.eq_active[weld] = 1
        model.geom_contype[self._lands] = 0
        model.geom_conaffinity[self._lands] = 0

    def release(self, model: mujoco.MjModel, data: mujoco.MjData) -> None:
        """Open the welds and restore the contacts of the layers in `model` and `data`. `model` is the model of the
        cell or a copy of this model.
        """
        data.eq_active[self._welds] = 0
        model.geom_contype[self._lands], model.geom_conaffinity[self._lands] = self._bits


def lands_of(drawn: mujoco.MjModel) -> NDArray[np.intp]:
    """Return the indices of the geoms that form the lands of gasket and top. The layers of the scene must not be
    clamped.
    """
    return np.flatnonzero(np.isin(drawn.geom_contype, _LANDS))
