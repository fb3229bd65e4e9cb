"""A state of a scene solved on both paths of MuJoCo's Newton solver: sparse and dense Jacobian of the constraints.

Both minimise the same cost, so that acceleration and forces are to be the same, reached in as many iterations. A wrong
factor of the Hessian on one of them shows in iterations first: a step that is none of Newton's still goes downhill.
"""

from dataclasses import dataclass
from typing import Final

import mujoco
import numpy as np

from handeye.core.pose import Array

SPARSE, DENSE = int(mujoco.mjtJacobian.mjJAC_SPARSE), int(mujoco.mjtJacobian.mjJAC_DENSE)
CG: Final = int(mujoco.mjtSolver.mjSOL_CG)
STATE: Final = int(mujoco.mjtState.mjSTATE_INTEGRATION)


@dataclass(frozen=True, slots=True, kw_only=True)
class Solution:
    """What the solver made of a state."""

    qacc: Array
    """Accelerations, shape (nv,)."""
    pull: Array
    """Generalised forces of all constraints, shape (nv,)."""
    forces: Array
    """Of each row of the constraints, shape (nefc,)."""
    iterations: tuple[int, ...]
    """Of Newton's method, for each island."""
    unbalanced: Array
    """M qacc - (smooth forces) - (constraint forces), shape (nv,): zero where the cost is least."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Solved:
    """A state solved on both paths, from the same beginning."""

    where: str
    """Which state of which scene."""
    sparse: Solution
    dense: Solution

    @property
    def apart(self) -> float:
        """How far the paths are apart: the largest of the relative differences of what they found."""
        return max(
            relative(self.sparse.qacc, self.dense.qacc),
            relative(self.sparse.pull, self.dense.pull),
            relative(self.sparse.forces, self.dense.forces),
        )

    @property
    def longer(self) -> int:
        """By how many iterations the sparse path is the longer one, at most, in an island."""
        return max(s - d for s, d in zip(self.sparse.iterations, self.dense.iterations, strict=True))


def relative(a: Array, b: Array) -> float:
    """The largest difference of two arrays over the largest value."""
    return float(np.abs(a - b).max(initial=0.0) / max(np.abs(b).max(initial=0.0), 1e-9))


def solved(
    model: mujoco.MjModel, data: mujoco.MjData, *, where: str = "", solver: int | None = None
) -> list[Solved]:
    """A state on both paths: from the solution of the step before, and from nothing.

    Args:
        solver: another method than Newton's on the sparse path.
    """
    state = np.empty(mujoco.mj_stateSize(model, STATE))
    mujoco.mj_getState(model, data, state, STATE)
    scratch, was = mujoco.MjData(model), (model.opt.jacobian, model.opt.solver)
    try:
        return [
            Solved(
                where=f"{where}, {'warm' if warm else 'cold'}",
                sparse=_solution(model, scratch, state, SPARSE, was[1] if solver is None else solver, warm),
                dense=_solution(model, scratch, state, DENSE, was[1], warm),
            )
            for warm in (True, False)
        ]
    finally:
        model.opt.jacobian, model.opt.solver = was


def _solution(
    model: mujoco.MjModel, data: mujoco.MjData, state: Array, path: int, solver: int, warm: bool
) -> Solution:
    model.opt.jacobian, model.opt.solver = path, solver
    mujoco.mj_resetData(model, data)
    mujoco.mj_setState(model, data, state, STATE)
    if not warm:
        data.qacc_warmstart[:] = 0.0
    mujoco.mj_forward(model, data)
    inertial = np.zeros(model.nv)
    mujoco.mj_mulM(model, data, inertial, data.qacc)
    return Solution(
        qacc=data.qacc.copy(),
        pull=data.qfrc_constraint.copy(),
        forces=data.efc_force.copy(),
        iterations=tuple(data.solver_niter[: max(1, data.nisland)].tolist()),
        unbalanced=inertial - data.qfrc_smooth - data.qfrc_constraint,
    )
