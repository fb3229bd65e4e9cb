"""The executed steps of a relay, and the memories of its programs, read from a state."""

from dataclasses import dataclass

import msgspec

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadFile, Refused
from handeye.execution.state import ReversalOrder
from handeye.program.system_state import SystemState
from handeye.systems.relay.plan import Leg, RelayPlan, legs, listing
from handeye.systems.relay.state import RelayCore


@dataclass(frozen=True, slots=True)
class LegStep:
    """An executed step of a leg. The step has not been undone."""

    step: int
    enters: bool


def memories(plan: RelayPlan, state: RelayCore) -> dict[str, SystemState]:
    """Return the memories of the programs. The keys are the files of the programs. Raises BadFile if a memory is
    missing.
    """
    try:
        return {program.file: getattr(state, program.system)[program.file] for program in plan.programs}
    except KeyError as missing:
        raise BadFile(f"the state of the run lacks the memory of the program {missing}") from None


def fits(plan: RelayPlan, state: RelayCore) -> bool:
    """Return True if the leg and the steps that a state names exist in the relay."""
    count = range(len(listing(plan).steps))
    return state.leg in range(len(plan.legs)) and all(
        number is None or number in count for number in (state.at, state.onward)
    )


def last_leg(state: RelayCore) -> int:
    """Return the index of the leg that moved the arm last."""
    return state.leg if state.entered or not state.leg else state.leg - 1


def executed(plan: RelayPlan, state: RelayCore) -> list[LegStep]:
    """Return the executed steps of all legs, in the order of the legs. Steps that were undone are left out."""
    found = []
    for leg in legs(plan)[: state.leg + 1]:
        own = leg.system.executed(leg.plan, memories(plan, state)[leg.file])
        found += [
            LegStep(leg.first + each.step - leg.steps[0], each.enters)
            for each in own
            if each.step in leg.steps
        ]
    return found


def own_legs(plan: RelayPlan, state: RelayCore) -> tuple[Leg, ...]:
    """Return the leg that has the arm, and the legs directly before it that belong to the same program. The leg that
    has the arm comes last.
    """
    all_legs, here = legs(plan), last_leg(state)
    first = here
    while first and all_legs[first - 1].file == all_legs[here].file:
        first -= 1
    return all_legs[first : here + 1]


def check_order(plan: RelayPlan, state: RelayCore, undoing: ReversalOrder) -> None:
    """Raise Refused if an order would undo no steps at all, or if it would undo a step of a leg whose steps cannot be
    undone.
    """
    passed = legs(plan)[: last_leg(state) + 1]
    done = executed(plan, state)
    fast = next((leg for leg in reversed(passed) if not leg.system.undoes), None)
    if fast is not None and undoing.left < sum(each.step < fast.numbers.stop for each in done):
        later = passed[fast.index + 1 :]
        back_to = (
            f"; the arm can undo only the steps back to the stage {quoted(later[0].stage)}" if later else ""
        )
        raise Refused(f"the leg {quoted(fast.stage)}, which {fast.file} has done, cannot be undone{back_to}")
    if undoing.left >= len(done):
        raise Refused("there is nothing to undo")


def own_order(plan: RelayPlan, state: RelayCore, undoing: ReversalOrder) -> ReversalOrder | None:
    """Return the part of an order to undo that the present program can carry out: the steps that this program has
    executed since it took the arm over. The returned order has this program's own step numbers. Returns None if the
    order names none of these steps.
    """
    own, done = own_legs(plan, state), executed(plan, state)
    before = sum(each.step < own[0].first for each in done)
    left = max(undoing.left, before)
    if left >= len(done):
        return None
    whole = len(own[0].system.executed(own[0].plan, memories(plan, state)[own[0].file]))
    return msgspec.structs.replace(
        undoing, left=whole - (len(done) - left), halts=undoing.halts or left > undoing.left
    )
