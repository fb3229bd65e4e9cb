"""`handeye cache`: calibrations that are kept for other runs."""

from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import Json, put_json, say
from handeye.core.plain_text import counted

if TYPE_CHECKING:
    from handeye.systems.stanford.kept_calibrations import KeptCalibration, KeptCalibrations

SHOWN: Final = 20  # the newest calibrations
_AGES: Final = ((86400.0, "d"), (3600.0, "h"), (60.0, "min"), (1.0, "s"))


def cache(
    *,
    clear: Annotated[bool, Parameter(help="Remove all kept calibrations.")] = False,
    json: Json = False,
) -> int:
    """List the kept camera calibrations, or remove them.

    What the arm measures of itself and of the camera before the first instruction is kept for other runs in the same
    world, with the same pictures and versions: they give the same bytes and need not wait. `--calibrate` measures
    again. All of them take at most 16 MB, some 6 kB each; the oldest go. The environment variable HANDEYE_CACHE names
    another folder than that of the platform; if it is empty, nothing is kept.
    """
    from handeye.systems.stanford.kept_calibrations import KeptCalibrations

    kept = KeptCalibrations.of_user()
    removed = kept.clear() if clear else 0
    entries = list(kept.entries())
    if json:
        put_json(
            {
                "folder": None if kept.folder is None else str(kept.folder),
                "most_bytes": kept.most,
                "removed": removed,
                "calibrations": entries,
            }
        )
    elif clear:
        say(f"{counted(removed, 'calibration')} removed")
    else:
        _show(kept, entries)
    return 0


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
