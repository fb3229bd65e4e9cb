"""What a run of a program leaves, as a record for other programs."""

from collections.abc import Sequence

from handeye.core.record import Record
from handeye.systems.trig.language.no_arm import NoArm
from handeye.systems.trig.language.obstacles import Obstacle
from handeye.systems.trig.language.place import Measures, Place
from handeye.systems.trig.language.position import is_named
from handeye.systems.trig.language.running import Ran
from handeye.systems.trig.language.session import Session


class Way(Record, frozen=True, kw_only=True):
    """One run, forwards or backwards."""

    steps: int
    end: str
    obstacle: Obstacle | None = None
    """What stopped it."""


class BlockPlace(Record, frozen=True, kw_only=True):
    """An imagined block, by the middle of its upper face."""

    name: str
    at: tuple[float, float, float]
    """mm"""


class TrigReport(Record, frozen=True, kw_only=True):
    """A program that was run. Millimetres and degrees."""

    forward: Way
    back: Way | None
    arm: Measures
    closed: bool
    cursor: str | None
    """The active step, if it has a name."""
    positions: dict[str, Measures]
    """As they are now."""
    blocks: tuple[BlockPlace, ...]


def report(session: Session, ways: Sequence[Ran]) -> TrigReport:
    """Tell how runs have ended, and where everything is."""
    told = [Way(steps=ran.steps, end=ran.end, obstacle=ran.obstacle) for ran in ways]
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
