"""Results on disk, those of an older handeye brought up to date as far as they go."""

from math import nan
from pathlib import Path
from typing import Any, Final

import msgspec

from handeye.core.errors import BadFile
from handeye.core.files import read_whole
from handeye.results.result import Result
from handeye.tasks import DEFAULT

_LARGEST: Final = 1 << 24
"""Bytes: thousands of times what a result has."""
_RENAMED: Final = {
    "planning_wall_s": "planning_cpu_s",
    "vision_wall_s": "vision_cpu_s",
    "wall_s": "run_wall_s",
}
"""Fields of the timing that bore another name."""
_ADDED: Final = ("calibration_s", "run_cpu_s", "host_from_step")
"""Fields of the timing that there were not, and that nothing makes up for."""


def read_result(path: Path) -> tuple[Result, tuple[str, ...]]:
    """The result in a file, and the names of what an older handeye did not record.

    Raises:
        InvalidInput: it cannot be read, or is no result.
    """
    try:
        written = msgspec.json.decode(read_whole(path, _LARGEST))
        missing = _bring_up_to_date(written) if isinstance(written, dict) else ()
        return msgspec.convert(written, Result), missing
    except (msgspec.DecodeError, UnicodeDecodeError, RecursionError) as error:
        raise BadFile(f"{path} is not the result of a run: {error}") from None


def _bring_up_to_date(result: dict[str, Any]) -> tuple[str, ...]:
    """Write a result as it would be written today; the names of what it lacks."""
    missing = []
    for name, value in (
        ("task", DEFAULT),
        ("program", ""),
        ("world", {"seed": result.get("seed"), "drawing": 1}),
    ):
        if name not in result:
            result[name] = value
            missing.append(name)
    checks = result.get("referee")
    for check in checks.values() if isinstance(checks, dict) else ():
        restore_figures(check)
        _complete(check)
    timing = result.get("timing")
    return (*missing, *(_retimed(timing) if isinstance(timing, dict) else ()))


def _retimed(timing: dict[str, Any]) -> tuple[str, ...]:
    """Times in the fields of today; the names of those that are not known."""
    for newer in ("friction_s", "overlapped_s"):
        timing.setdefault(newer, None)
    if "total_s" not in timing:
        return ()
    del timing["total_s"]  # it added seconds of the host to those of the cell
    for old, new in _RENAMED.items():
        timing[new] = timing.pop(old, None)
    parts = timing.get("manipulation_s"), timing.get("lens_s")
    timing["working_s"] = sum(part for part in parts if isinstance(part, int | float))
    timing.update(dict.fromkeys(_ADDED))
    return _ADDED


def restore_figures(check: Any) -> None:
    """Give a finding the figures back that JSON has no numbers for: what is not finite is null there."""
    for name in ("value", "limit"):
        if isinstance(check, dict) and name in check and check[name] is None:
            check[name] = nan


def _complete(check: Any) -> None:
    """Add to a finding of the referee what it did not say: what it is about, and how it stands to its limit."""
    match check:
        case {
            "ok": bool(ok),
            "value": int() | float() as value,
            "limit": int() | float() as limit,
            "sentence": said,
        }:
            check.setdefault("subject", said)
            check.setdefault("relation", "at most" if (value <= limit) == ok else "at least")
