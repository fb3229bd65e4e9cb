"""A record of the runs of a TRIG program, in a form that other software can read."""

from collections.abc import Sequence

from handeye.core.record import Record
from handeye.systems.trig.language.no_arm import NoArm
from handeye.systems.trig.language.place import Measures, Place, is_named
from handeye.systems.trig.language.running import RunResult
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.trig_arm import Obstacle


class RunLeg(Record, frozen=True, kw_only=True):
    """One run, forwards or backwards."""

    steps: int
    end: str
    obstacle: Obstacle | None = None  # what stopped it


class BlockPlace(Record, frozen=True, kw_only=True):
    """An imaginary block, given by the centre of its upper face (mm)."""

    name: str
    at: tuple[float, float, float]


class TrigReport(Record, frozen=True, kw_only=True):
    """The result of a program run, in millimetres and degrees."""

    forward: RunLeg
    back: RunLeg | None
    arm: Measures
    closed: bool
    cursor: str | None  # the active step's name, if any
    positions: dict[str, Measures]  # present values
    blocks: tuple[BlockPlace, ...]


def report(session: Session, ways: Sequence[RunResult]) -> TrigReport:
    """Return a record of the run forwards and, if `ways` has a second result, of the run backwards. The record also
    contains the final state of arm and blocks.
    """
    told = [RunLeg(steps=ran.steps, end=ran.end, obstacle=ran.obstacle) for ran in ways]
    known = session.program.positions
    blocks = session.arm.blocks if isinstance(session.arm, NoArm) else ()
    return TrigReport(
        forward=told[0],
        back=told[1] if len(told) > 1 else None,
        arm=session.arm.here().measures(),
        closed=session.arm.closed,
        cursor=session.program.active.name,
        positions={name: position.data.measures() for name, position in known.items() if is_named(name)},
        blocks=tuple(BlockPlace(name=b.name, at=Place(b.x, b.y, b.z).measures()[:3]) for b in blocks),
    )
