"""The command `handeye cache`, which shows the calibrations that are stored for later runs."""

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

    Before the first instruction, a run measures the arm's joints and calibrates the camera. handeye keeps the
    results, and uses them in later runs with the same world, kind of pictures and versions. Such a run starts at once,
    and gives the same bytes as a run that measures. `--calibrate` measures again. One calibration takes about 6 kB. All
    calibrations together take at most 16 MB; to keep this limit, the oldest are removed. The environment variable
    HANDEYE_CACHE names another folder; if it is empty, nothing is kept.
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
