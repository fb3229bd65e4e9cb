"""The kinds of systems there are, by name."""

from functools import lru_cache
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import NoSuchName
from handeye.core.record import Record
from handeye.planfile.store import written_digest
from handeye.program.event_reading import declare_events
from handeye.runs.setup import Setup
from handeye.runs.system import Listing, SystemKind
from handeye.systems.stanford.executor_run import PROGRAM
from handeye.systems.trig.run.system import TAUGHT

_KINDS: Final[dict[str, SystemKind]] = {}


def register(kind: SystemKind) -> None:
    """Let runs be driven by another kind of system, and its events be read."""
    declare_events(kind.name, kind.events)
    _KINDS[kind.name] = kind


for _kind in (PROGRAM, TAUGHT):
    register(_kind)


def system_kind(name: str) -> SystemKind:
    """The kind of a name.

    Raises:
        InvalidInput: there is none.
    """
    if name not in _KINDS:
        raise NoSuchName(f"there is no system {quoted(name)} here; there are {', '.join(_KINDS)}")
    return _KINDS[name]


def kind_of(setup: Setup) -> SystemKind:
    """The kind of system that carries a run out."""
    return system_kind(setup.system)


def listing_of(setup: Setup) -> Listing:
    """Stages and steps of a run."""
    return kind_of(setup).listing(setup.plan)


def written(setup: Setup) -> bytes:
    """The plan of a run as bytes. Every checkpoint has them, so they are made once."""
    return _written(_Identical(setup.system, setup.plan))


def digest_of(setup: Setup) -> str:
    """Sixteen hexadecimal digits that stand for what is carried out."""
    return written_digest(written(setup))


class _Identical:
    """A plan that equals itself only: to compare two takes as long as to write one."""

    def __init__(self, system: str, plan: Record) -> None:
        self.system, self.plan = system, plan

    def __hash__(self) -> int:
        return id(self.plan)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Identical) and other.system == self.system and other.plan is self.plan


@lru_cache(maxsize=2)
def _written(what: _Identical) -> bytes:
    return system_kind(what.system).encode(what.plan)
