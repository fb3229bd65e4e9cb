"""Finds systems by name. Each system is loaded from its entry on first use."""

from functools import lru_cache
from pathlib import Path

from handeye.core.entries import entries, entry_named, loaded
from handeye.core.record import Record
from handeye.runs.setup import Setup
from handeye.runs.system import Listing, System


def system_named(name: str) -> System:
    """Return the system called `name`. Raises InvalidInput if no system has this name."""
    found: System = loaded(entry_named(name).system)
    return found


def system_of(setup: Setup) -> System:
    """Return the system of a run."""
    return system_named(setup.system)


def system_of_files(folder: Path) -> System | None:
    """Return the system whose own files are in the folder of a run, or None if no system has files there."""
    found = (e for e in entries().values() if any((folder / name).is_file() for name in e.files))
    return next((system_named(entry.name) for entry in found), None)


def listing_of(setup: Setup) -> Listing:
    return system_of(setup).listing(setup.plan)


def written(setup: Setup) -> bytes:
    """Encode the plan of a run. The bytes are cached, because every checkpoint needs them."""
    return _written(_Identical(setup.system, setup.plan))


def digest_of(setup: Setup) -> str:
    """Return sixteen hexadecimal digits that identify the plan of a run."""
    return _digest(_Identical(setup.system, setup.plan))


def same_plan(one: Setup, other: Setup) -> bool:
    """Return True if two runs use the same plan, apart from the last digits of computed numbers."""
    return one.system == other.system and (
        one.plan is other.plan or system_of(one).alike(one.plan, other.plan)
    )


class _Identical:
    """Wraps a plan so that it is compared by identity, because comparing two plans takes as long as encoding
    one."""

    def __init__(self, system: str, plan: Record) -> None:
        self.system, self.plan = system, plan

    def __hash__(self) -> int:
        return id(self.plan)

    def __eq__(self, other: object) -> bool:
        return isinstance(other, _Identical) and other.system == self.system and other.plan is self.plan


@lru_cache(maxsize=2)
def _digest(what: _Identical) -> str:
    return system_named(what.system).digest(what.plan, _written(what))


@lru_cache(maxsize=2)
def _written(what: _Identical) -> bytes:
    return system_named(what.system).encode(what.plan)
