"""The first grasp of a part: where a program that has found it first closes the hand on it."""

from handeye.arm.hand import HandModel
from handeye.core.record import Record
from handeye.planning.grasp_state import GraspState
from handeye.program.program import Program


class FirstGrasp(Record, frozen=True, kw_only=True):
    """Where a hand is to close, and how wide it is open then."""

    position: str
    gap: float
    """m."""


def first_grasp(program: Program, hand: HandModel, after: int, part: str) -> FirstGrasp | None:
    """The first grasp at a position of a part after a step, in the order of the text; None if there is none."""
    state = GraspState(program, hand)
    for number, step in enumerate(program.steps):
        gap, grasped = state.gap, state.closed_at is not None
        state.follow(number, step)
        position = state.closed_at
        if number > after and position and not grasped and program.positions[position].of == part:
            return FirstGrasp(position=position, gap=gap)
    return None
