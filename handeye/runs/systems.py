"""The kinds of systems there are, by name."""

from typing import Final

from handeye.diagnostics import quoted
from handeye.errors import InvalidInput
from handeye.planfile.store import written_digest
from handeye.runs.programs import PROGRAM
from handeye.runs.setup import Setup
from handeye.runs.system import Listing, SystemKind

_KINDS: Final = {PROGRAM.name: PROGRAM}


def register(kind: SystemKind) -> None:
    """Let runs be driven by another kind of system."""
    _KINDS[kind.name] = kind


def system_kind(name: str) -> SystemKind:
    """The kind of a name.

    Raises:
        InvalidInput: there is none.
    """
    if name not in _KINDS:
        raise InvalidInput(f"there is no system {quoted(name)} here; there are {', '.join(_KINDS)}")
    return _KINDS[name]


def kind_of(setup: Setup) -> SystemKind:
    """The kind of system that carries a run out."""
    return system_kind(setup.system)


def listing_of(setup: Setup) -> Listing:
    """Stages and steps of a run."""
    return kind_of(setup).listing(setup.plan)


def digest_of(setup: Setup) -> str:
    """Sixteen hexadecimal digits that stand for what is carried out."""
    return written_digest(kind_of(setup).encode(setup.plan))
