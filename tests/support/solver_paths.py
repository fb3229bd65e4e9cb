"""A state of a scene solved on both paths of MuJoCo's Newton solver: sparse and dense Jacobian of the constraints.

Both minimise the same cost. They should therefore find the same acceleration and forces in the same number of
iterations. A wrong factor of the Hessian on one path first shows in the number of iterations, because a wrong step
still reduces the cost.
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
    """The solution that the solver found for a state."""

    qacc: Array
    """Accelerations, shape (nv,)."""
    pull: Array
    """Generalised forces of all constraints, shape (nv,)."""
    forces: Array
    """Force of each row of the constraints, shape (nefc,)."""
    iterations: tuple[int, ...]
    """Iterations of Newton's method, for each island."""
    unbalanced: Array
    """M qacc - (smooth forces) - (constraint forces), shape (nv,): zero at the least cost."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Solved:
    """A state solved on both paths, from the same beginning."""

    where: str
    """The scene and the state, in words."""
    sparse: Solution
    dense: Solution

    @property
    def apart(self) -> float:
        """The largest relative difference between the solutions of the two paths."""
        return max(
            relative(self.sparse.qacc, self.dense.qacc),
            relative(self.sparse.pull, self.dense.pull),
            relative(self.sparse.forces, self.dense.forces),
        )

    @property
    def longer(self) -> int:
        """The greatest number of iterations, in any island, by which the sparse path is longer."""
        return max(s - d for s, d in zip(self.sparse.iterations, self.dense.iterations, strict=True))


def relative(a: Array, b: Array) -> float:
    """Return the largest difference between two arrays, divided by the largest value."""
    return float(np.abs(a - b).max(initial=0.0) / max(np.abs(b).max(initial=0.0), 1e-9))


def solved(
    model: mujoco.MjModel, data: mujoco.MjData, *, where: str = "", solver: int | None = None
) -> list[Solved]:
    """Solve a state on both paths: once from the solution of the previous step, and once from zero.

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
