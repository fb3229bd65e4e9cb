"""Reads and writes checkpoint files: one line with the format, one line of readable JSON, then the compressed
state.

The first line contains a digest of the rest of the file. A truncated or altered file is therefore refused before
handeye uses any of its content.
"""

import hashlib
import re
from pathlib import Path
from typing import Annotated, Final

import msgspec
from msgspec import UNSET, UnsetType

from handeye.cell.state import CellState
from handeye.core.errors import BadFile, InvalidInput
from handeye.core.files import Kind, read_whole, write_whole
from handeye.core.packed import decoded, encoded, packed, sealed, unpacked
from handeye.core.record import Record
from handeye.core.variation import WorldSpec
from handeye.core.versions import versions
from handeye.planfile.store import is_plan_of
from handeye.program.event_reading import read_packed
from handeye.program.events import RunStarted, StageFinished, StageStarted
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint, Snapshot
from handeye.runs.system import System
from handeye.runs.systems import digest_of, listing_of, system_named, system_of, written

MAGIC: Final = "handeye-checkpoint"
VERSION: Final = 5
ENDING: Final = ".checkpoint"
CHECKPOINT: Final = Kind("checkpoint", f"{MAGIC} ".encode())
LARGEST: Final = 1 << 28  # bytes of a state, decompressed: a hundred times what a run of the water pump needs


class Head(Record, frozen=True, kw_only=True):
    """Summary of a checkpoint. Users see the summary, and handeye uses it to find the right checkpoint without
    decoding states.
    """

    system: str = "program"  # name of the system that executes the run
    program: str
    plan: str  # digest of the plan
    arm: str
    arm_digest: str
    world: WorldSpec
    camera: str
    versions: dict[str, str]
    position: int  # steps done; -1: not begun
    stage: str | None
    between_stages: bool  # the next step begins the stage
    time: float | None  # s on the cell's clock
    touched: bool  # a person intervened, so the plan alone does not determine the state
    task: str
    judged: bool = False  # the referee judges the result
    limits: dict[str, float] | UnsetType = UNSET  # limits of findings, which replace the referee's own limits
    replaced: dict[str, str] | UnsetType = UNSET  # replaced parts; to resume, give parts of these names
    without: tuple[str, ...] | UnsetType = UNSET  # senses that are switched off for the program


class _Snapshot(Record, frozen=True, kw_only=True, omit_defaults=True):
    """A `Snapshot` whose state has not been decoded yet, because the type of the state depends on the system."""

    position: Annotated[int, msgspec.Meta(ge=0)]
    happened: Annotated[int, msgspec.Meta(ge=0)]
    cell: CellState | None
    state: msgspec.Raw


class _Body(Record, frozen=True, kw_only=True):
    plan: str
    snapshot: _Snapshot | None
    events: msgspec.Raw


def head_of(checkpoint: Checkpoint) -> Head:
    setup, snapshot = checkpoint.setup, checkpoint.snapshot
    arm, arm_digest = system_of(setup).machine(setup.plan)
    cell = None if snapshot is None else snapshot.cell
    time = None if snapshot is None else checkpoint.events[-1].time if cell is None else cell.time
    return Head(
        system=setup.system,
        program=listing_of(setup).name,
        plan=digest_of(setup),
        arm=arm,
        arm_digest=arm_digest,
        world=setup.world,
        camera=setup.camera,
        versions=versions(),
        position=checkpoint.position,
        stage=checkpoint.stage,
        between_stages=checkpoint.between_stages,
        time=None if time is None else round(time, 6),  # time of the last event if there is no cell
        touched=checkpoint.touched,
        task=setup.task,
        judged=setup.judged,
        limits=setup.limits or UNSET,
        replaced=setup.replaced or UNSET,
        without=setup.without or UNSET,
    )


def encode(checkpoint: Checkpoint) -> bytes:
    setup, snapshot = checkpoint.setup, checkpoint.snapshot
    body = _Body(
        plan=written(setup).decode(),
        snapshot=None if snapshot is None else _on_disk(snapshot),
        events=msgspec.Raw(encoded(checkpoint.events)),
    )
    head = msgspec.json.encode(head_of(checkpoint))
    return sealed(MAGIC, VERSION, head + b"\n" + packed(body))


def decode(data: bytes, name: str) -> Checkpoint:
    """Decode a checkpoint. Raises BadFile if the data are not a checkpoint, or if this version of handeye cannot use
    them. In messages, the file is called `name`.
    """
    head, rest = _opened(data, name)
    try:
        body = unpacked(rest, _Body, LARGEST)
    except ValueError as error:
        raise BadFile(f"{name} is not a valid checkpoint: {error}") from None
    kind = system_named(head.system)
    plan = kind.decode(body.plan.encode(), f"the plan in {name}")
    setup = Setup(
        system=kind.name,
        plan=plan,
        world=head.world,
        camera=head.camera,
        judged=head.judged,
        limits=head.limits or {},
        replaced=head.replaced or {},
        without=head.without or (),
    )
    try:
        kind.check(setup)
    except InvalidInput as error:
        raise BadFile(f"{name} cannot be used: {error}") from None
    try:
        events = read_packed(body.events, kind.name)
    except ValueError as error:
        raise BadFile(f"{name} is not a valid checkpoint: {error}") from None
    if body.snapshot is not None and (
        body.snapshot.happened != len(events) or not isinstance(next(iter(events), None), RunStarted)
    ):
        raise BadFile(f"{name} is not a valid checkpoint: its events are incomplete")
    checkpoint = Checkpoint(
        setup=setup,
        snapshot=None if body.snapshot is None else _in_memory(body.snapshot, kind, name),
        events=events,
    )
    listing = kind.listing(plan)
    begun = {event.stage for event in events if isinstance(event, StageStarted | StageFinished)}
    if not begun <= set(listing.stages):
        raise BadFile(f"{name} is not a valid checkpoint: it has stages that are not in its plan")
    first = next(iter(events), None)
    own = not isinstance(first, RunStarted) or is_plan_of(first, body.plan.encode())
    told = (head.task, head.program, head.position, head.touched)
    if not own or told != (setup.task, listing.name, checkpoint.position, checkpoint.touched):
        raise BadFile(f"{name} is not a valid checkpoint: its header does not match its content")
    return checkpoint


def _on_disk(snapshot: Snapshot) -> _Snapshot:
    return _Snapshot(
        position=snapshot.position,
        happened=snapshot.happened,
        cell=snapshot.cell,
        state=msgspec.Raw(encoded(snapshot.state)),
    )


def _in_memory(kept: _Snapshot, kind: System, name: str) -> Snapshot:
    try:
        state = decoded(kept.state, kind.state)
    except ValueError as error:
        raise BadFile(f"{name} is not a valid checkpoint: {error}") from None
    return Snapshot(
        position=kept.position,
        happened=kept.happened,
        cell=kept.cell,
        state=state,
    )


def decode_head(data: bytes, name: str) -> Head:
    """Decode the summary of a checkpoint. Like `decode`, this function checks the whole file for damage."""
    return _opened(data, name)[0]


def read_checkpoint(path: Path) -> Checkpoint:
    """Read the checkpoint in a file. Raises BadFile as `decode` does."""
    return decode(read_whole(path), str(path))


def read_head(path: Path) -> Head:
    """Read the summary of the checkpoint in a file. Raises BadFile as `decode` does."""
    return decode_head(read_whole(path), str(path))


def write_checkpoint(path: Path, checkpoint: Checkpoint) -> None:
    """Write a checkpoint atomically: either the whole file is written, or nothing."""
    write_whole(path, encode(checkpoint))


def _opened(data: bytes, name: str) -> tuple[Head, bytes]:
    """Return the summary and the compressed state of a checkpoint. Raises BadFile if the file is damaged."""
    first, _, rest = data.partition(b"\n")
    words = first.decode("ascii", errors="replace").split(" ")
    if len(words) != 3 or words[0] != MAGIC or not re.fullmatch(r"[1-9][0-9]{0,8}", words[1]):
        raise BadFile(f"{name} is not a checkpoint of handeye")
    if int(words[1]) != VERSION:
        raise BadFile(
            f"{name} has checkpoint format version {words[1]}; this version of handeye reads version "
            f"{VERSION}: start the run again, or resume it with the version that saved it"
        )
    if words[2] != hashlib.sha256(rest).hexdigest():
        raise BadFile(f"{name} is damaged or cut short: its checksum is wrong")
    line, _, body = rest.partition(b"\n")
    try:
        return msgspec.json.decode(line, type=Head), body
    except msgspec.DecodeError as error:
        raise BadFile(f"{name} is not a valid checkpoint: {error}") from None
