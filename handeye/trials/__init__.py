"""Whole runs and statistics over them: where concrete cells, plans and referees are put together."""

from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from handeye.trials.results import assemble_each

__all__ = ["assemble_each"]


def __getattr__(name: str) -> Any:
    """Import `assemble_each` when it is asked for: it is seldom wanted where something in this folder is."""
    if name != "assemble_each":
        raise AttributeError(name)
    from handeye.trials.results import assemble_each

    return assemble_each
