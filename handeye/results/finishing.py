"""Ends or pauses a run: writes its account, verdict, pictures and result to its folder."""

import msgspec
from msgspec import UNSET

from handeye.core.files import write_whole
from handeye.results.judging import Referee, findings
from handeye.results.pictures import keep_pictures
from handeye.results.result import Result, to_json
from handeye.results.summary import summary
from handeye.runs.advance import Pause
from handeye.runs.folder import PICTURES, RESULT, RunFolder
from handeye.runs.host_seconds import Meter
from handeye.runs.parts import deciding, name_of
from handeye.runs.runner import Runner


def outcome(
    runner: Runner, pause: Pause, meter: Meter, *, judged: bool, referee: Referee | None = None
) -> Result:
    """Make the result of a paused run. If `judged` is True and the run has ended, `referee` judges the run. If
    `referee` is None, the task's referee judges the run.
    """
    asked = judged and pause.kind != "break" and runner.system.cell is not None
    found = findings(runner, pause, referee) if asked else None
    built = runner.system.built() if asked and runner.undone else {}
    result = summary(runner, pause, findings=found, built=built, host=meter.seconds(runner))
    others = deciding(runner.setup.replaced) | ({} if referee is None else {"referee": name_of(referee)})
    limits = runner.setup.limits if found is not None and referee is None else None
    return msgspec.structs.replace(
        result,
        limits=limits or UNSET,
        replaced=others or UNSET,
        without=runner.setup.without or UNSET,
        figures=dict(runner.system.figures) or UNSET,
    )


def finished(
    runner: Runner,
    pause: Pause,
    meter: Meter,
    *,
    judged: bool,
    referee: Referee | None = None,
    folder: RunFolder | None = None,
) -> Result:
    """End the run, unless it has only paused and can continue. In both cases, write the pictures and the result of the
    run to its folder, if it has one. Returns the result.

    The result is written last. A folder with a result therefore contains all other files, too. Raises InvalidInput if
    a file cannot be written.
    """
    if pause.kind != "break":
        runner.finish()
    result = outcome(runner, pause, meter, judged=judged, referee=referee)
    if folder is not None:
        keep_outcome(folder, runner, pause, result)
    return result


def keep_outcome(
    folder: RunFolder, runner: Runner, pause: Pause, result: Result, *, photographs: bool = True
) -> None:
    """Write the pictures and the result to the folder of a run, and close the folder. Raises InvalidInput if a file
    cannot be written.
    """
    folder.close()
    keep_pictures(folder.path / PICTURES, runner, photographs=photographs)
    for name, data in runner.kind.files(runner, pause, result).items():
        write_whole(folder.path / name, data)
    write_whole(folder.path / RESULT, to_json(result))
