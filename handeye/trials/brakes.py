"""Whether the brakes of an arm are on, by the truth of its cell and not by what a program told it."""

from handeye.cell.arm import ArmState
from handeye.cell.simulated import SimulatedCell


def brakes_hold(cell: SimulatedCell) -> bool:
    """True if the brakes were on in the last moment and are told to stay, and no motor of the arm has a torque."""
    state = cell.truth.states[cell.arm.name]
    assert isinstance(state, ArmState)
    return state.braked and state.command is None and not cell.truth.data.ctrl[cell.arm.motors].any()
