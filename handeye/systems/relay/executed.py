"""The executed steps of a relay, and the memories of its programs, read from a state."""

from dataclasses import dataclass

import msgspec

from handeye.core.errors import BadFile, Refused
from handeye.execution.state import ReversalOrder
from handeye.program.system_state import SystemState
from handeye.systems.relay.plan import RelayPlan, legs, listing
from handeye.systems.relay.state import RelayCore


@dataclass(frozen=True, slots=True)
class LegStep:
    """An executed step of a leg that has not been undone."""

    step: int
    enters: bool


def memories(plan: RelayPlan, state: RelayCore) -> dict[str, SystemState]:
    """Return the memories of the programs, by file. Raises BadFile if one is missing."""
    try:
        return {program.file: getattr(state, program.system)[program.file] for program in plan.programs}
    except KeyError as missing:
        raise BadFile(f"the state of the run has no memory of {missing}") from None


def fits(plan: RelayPlan, state: RelayCore) -> bool:
    """Return True if all places of a state are in a relay."""
    count = range(len(listing(plan).steps))
    return state.leg in range(len(plan.legs)) and all(
        number is None or number in count for number in (state.at, state.onward)
    )


def last_leg(state: RelayCore) -> int:
    """Return the index of the leg that moved the arm last."""
    return state.leg if state.entered or not state.leg else state.leg - 1


def executed(plan: RelayPlan, state: RelayCore) -> list[LegStep]:
    """Return the executed steps of all legs that have not been undone, in the order of the legs."""
    found = []
    for leg in legs(plan)[: state.leg + 1]:
        own = leg.system.executed(leg.plan, memories(plan, state)[leg.file])
        found += [
            LegStep(leg.first + each.step - leg.steps[0], each.enters)
            for each in own
            if each.step in leg.steps
        ]
    return found


def own_order(plan: RelayPlan, state: RelayCore, undoing: ReversalOrder) -> ReversalOrder:
    """Return an order to reverse steps, in the numbers of the program that has the arm. Raises Refused if it would
    reverse steps of another program.
    """
    here = legs(plan)[last_leg(state)]
    others = [leg for leg in legs(plan)[: here.index] if leg.file != here.file]
    own = legs(plan)[others[-1].index + 1 if others else 0]
    done = executed(plan, state)
    kept = sum(each.step < own.first for each in done)
    if undoing.left < kept:
        raise Refused(
            f"only the steps of {here.file} can be undone here; {others[-1].file} did the leg before them"
        )
    if undoing.left >= len(done):
        raise Refused("there is nothing to undo")
    whole = len(here.system.executed(here.plan, memories(plan, state)[here.file]))
    return msgspec.structs.replace(undoing, left=whole - (len(done) - undoing.left))
