"""Executes whole runs, and computes statistics over many of them."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from handeye.trials.results import assemble_each

__all__ = ["assemble_each"]


def __getattr__(name: str) -> Any:
    """Import `assemble_each` on first use, because most importers of this package do not need it."""
    if name != "assemble_each":
        raise AttributeError(name)
    from handeye.trials.results import assemble_each

    return assemble_each
