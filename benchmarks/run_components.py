"""Components of a run, between which its processor time is divided, and the functions that each begins with.

What a function calls belongs to it, unless that is one of these itself. There is no other way in: ports see neither the
simulator behind them nor the planner before them. So these are replaced, by their names, for as long as is measured.
"""

from collections.abc import Iterator
from contextlib import contextmanager
from functools import partial
from typing import Any, Final

from benchmarks.cpu_account import OTHER, CpuAccount
from benchmarks.tape import physics_through
from handeye.arm.trajectory import Trajectory
from handeye.cell.camera import SimulatedCamera
from handeye.cell.simulated import SimulatedCell
from handeye.execution import camera_calibration, motion_actions, vision_actions
from handeye.execution.drive import ArmDrive
from handeye.runs import advance
from handeye.runs.runner import Runner

PHYSICS: Final = "physics"
PICTURES: Final = ("rendering", "vision")
"""Components that are there only where the arm has an eye."""
COMPONENTS: Final = {
    PHYSICS: "MuJoCo: steps, and forward dynamics where something was put elsewhere",
    "devices": "simulated devices and threads, before and after each step of the physics",
    "servo": "the servo loop: sensors, set-points, torques, guards",
    "motions": "motions made or adjusted before they begin: inverse kinematics, trajectories",
    "rendering": "pictures made",
    "vision": "pictures looked at",
    "snapshots": "the state after each step, kept and put back",
    "records": "events, progress, and trace and checkpoints if they are kept",
    OTHER: "all else: instructions, world model",
}
"""The meaning of each, in the order of the report."""
_FUNCTIONS: Final[dict[str, tuple[tuple[Any, tuple[str, ...]], ...]]] = {
    "devices": ((SimulatedCell, ("advance",)),),
    "servo": ((ArmDrive, ("_pass",)),),
    "motions": (
        (motion_actions, ("_trajectory", "change_samples", "turn_samples", "directions")),
        (Trajectory, ("sample",)),
    ),
    "rendering": ((SimulatedCamera, ("digitise",)),),
    "vision": (
        (vision_actions, ("locate_general", "locate_specific", "inspect_gasket", "blank", "repeated")),
        (camera_calibration, ("find_spot", "calibrate", "repeated")),
    ),
    "snapshots": ((Runner, ("_settle",)),),
    "records": ((Runner, ("_emit", "_watch")), (advance, ("keep",))),
}


@contextmanager
def charged_to(account: CpuAccount) -> Iterator[None]:
    """While entered, what any run in this process takes is charged to its components."""
    functions = [
        (owner, name, component)
        for component, owners in _FUNCTIONS.items()
        for owner, names in owners
        for name in names
    ]
    with account.charging(functions), physics_through(partial(account.charged, component=PHYSICS)):
        yield
