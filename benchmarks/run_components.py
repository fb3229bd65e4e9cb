"""Defines the components of a run for which processor time is counted, and the functions with which each begins.

Everything that such a function calls counts for the same component, except calls of other functions listed here. The
functions are replaced by name during the measurement, because ports give access to neither simulator nor planner.
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
"""Components that exist only if the cell has a camera."""
COMPONENTS: Final = {
    PHYSICS: "MuJoCo: steps, and forward dynamics after a part was moved",
    "devices": "simulated devices and threads, before and after each step of the physics",
    "servo": "the servo loop: sensors, set-points, torques, guards",
    "motions": "motions made or adjusted before they begin: inverse kinematics, trajectories",
    "rendering": "pictures made",
    "vision": "pictures analysed",
    "snapshots": "the state after each step, captured and restored",
    "records": "events, progress, and, if they are written, trace and checkpoints",
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
    """Within this context, the time of any run in this process counts for its components."""
    functions = [
        (owner, name, component)
        for component, owners in _FUNCTIONS.items()
        for owner, names in owners
        for name in names
    ]
    with account.charging(functions), physics_through(partial(account.charged, component=PHYSICS)):
        yield
