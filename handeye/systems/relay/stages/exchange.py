"""Replaces the program of the next leg of a relay by another program."""

import msgspec

from handeye.core.mutable_records import copied
from handeye.planfile.store import written_digest
from handeye.program.events import RunStarted
from handeye.runs.snapshot import Checkpoint
from handeye.runs.system import RunCallbacks
from handeye.systems.relay.plan import RelayPlan, listing
from handeye.systems.relay.state import RelayCore
from handeye.systems.relay.system import RELAY


def exchanged(start: Checkpoint, plan: RelayPlan) -> Checkpoint:
    """Return a checkpoint of another relay, in the state of `start`. Both relays must have the same legs up to this
    state, and `start` must be between two legs. A program that only the other relay has begins with an empty memory.
    """
    snapshot = start.snapshot
    assert snapshot is not None
    assert isinstance(snapshot.state, RelayCore)
    setup = msgspec.structs.replace(start.setup, plan=plan)
    around = RunCallbacks(emit=lambda _: None, watch=lambda _: None, halt=lambda: False)
    empty, state = RELAY.build(setup, around).state, copied(snapshot.state)
    for program in plan.programs:
        known, fresh = getattr(state, program.system), getattr(empty, program.system)
        known.setdefault(program.file, fresh[program.file])
    data = RELAY.encode(plan)
    begun = {
        "program": plan.name, "steps": len(listing(plan).steps),
        "plan": RELAY.digest(plan, data), "content": written_digest(data),
    }  # fmt: skip
    return Checkpoint(
        setup=setup,
        snapshot=msgspec.structs.replace(snapshot, state=state),
        events=tuple(
            msgspec.structs.replace(event, **begun) if isinstance(event, RunStarted) else event
            for event in start.events
        ),
    )
