"""The command `handeye cache`, which shows the calibrations that are stored for later runs."""

from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import Json, put_json, say
from handeye.core.plain_text import counted

if TYPE_CHECKING:
    from pathlib import Path

    from handeye.systems.stanford.kept_calibrations import KeptCalibration, KeptCalibrations

SHOWN: Final = 20  # the newest calibrations
_AGES: Final = ((86400.0, "d"), (3600.0, "h"), (60.0, "min"), (1.0, "s"))


def cache(
    *,
    clear: Annotated[
        bool, Parameter(help=("Remove all kept calibrations, and all kept states in which episodes start."))
    ] = False,
    json: Json = False,
) -> int:
    """List the kept camera calibrations and start states, or remove them.

    Before the first instruction, a run measures the arm's joints and calibrates the camera. handeye keeps the results,
    and uses them in later runs with the same world, the same kind of pictures and the same versions of the software. A
    run that uses kept results starts at once, and its trace has the same bytes as the trace of a run that measures.
    `--calibrate` measures again. One calibration takes about 6 kB. All calibrations together take at most 16 MB; to
    keep this limit, handeye removes the oldest calibrations. To keep the files in another folder, write its path into
    the environment variable HANDEYE_CACHE. If this variable is set but empty, nothing is kept.

    The environments for learned policies also keep the states in which their episodes start. These states take at most
    256 MB.
    """
    from handeye.runs.starts import kept_starts, starts_folder
    from handeye.systems.stanford.kept_calibrations import KeptCalibrations

    kept, starts = KeptCalibrations.of_user(), kept_starts(starts_folder())
    removed = kept.clear() if clear else 0
    for start in starts if clear else ():
        start.unlink(missing_ok=True)
    entries = list(kept.entries())
    if json:
        put_json(
            {
                "folder": None if kept.folder is None else str(kept.folder),
                "most_bytes": kept.most,
                "removed": removed,
                "calibrations": entries,
                "starts": 0 if clear else len(starts),
            }
        )
    elif clear:
        also = f" and {counted(len(starts), 'start state')}" if starts else ""
        say(f"{counted(removed, 'calibration')}{also} removed")
    else:
        _show(kept, entries)
        _show_starts(starts)
    return 0


def _show_starts(starts: "list[Path]") -> None:
    if starts:
        from handeye.runs.starts import MOST

        size = sum(path.stat().st_size for path in starts)
        say(
            f"{counted(len(starts), 'start state')} of environments, {size / 1e6:.1f} MB of at most {MOST >> 20} MB"
        )


def _show(kept: "KeptCalibrations", entries: list["KeptCalibration"]) -> None:
    if kept.folder is None:
        say(
            "no calibrations are kept: the environment variable HANDEYE_CACHE is empty, or there is no home folder"
        )
        return
    size = sum(entry.bytes for entry in entries)
    say(f"{kept.folder}", whole=True)
    say(f"{counted(len(entries), 'calibration')}, {size / 1000:.0f} kB of at most {kept.most >> 20} MB")
    for entry in entries[:SHOWN]:
        say(f"{_age(entry.age_s):>7} old  {entry.bytes / 1000:3.0f} kB  {entry.task}, {entry.world}")
    if len(entries) > SHOWN:
        say(f"and {len(entries) - SHOWN} older")


def _age(seconds: float) -> str:
    size, unit = next((pair for pair in _AGES if seconds >= pair[0]), _AGES[-1])
    return f"{seconds / size:.0f} {unit}"
