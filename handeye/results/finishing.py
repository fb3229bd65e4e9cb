"""The end of a run, or a pause in it: account, verdict, pictures and result, in its folder."""

from handeye.core.files import write_whole
from handeye.results.judging import Referee
from handeye.results.outcome import outcome
from handeye.results.pictures import keep_pictures
from handeye.results.result import Result, to_json
from handeye.runs.advance import Pause
from handeye.runs.folder import PICTURES, RESULT, RunFolder
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner


def finished(
    runner: Runner,
    pause: Pause,
    meter: Meter,
    *,
    judged: bool,
    referee: Referee | None = None,
    folder: RunFolder | None = None,
) -> Result:
    """Finish a run, unless it only pauses; its result, which is kept in its folder with the pictures.

    The result is written last: where there is one, all else is there, too. Raises InvalidInput if the folder cannot be
    written to.

    Args:
        meter: measures what the run costs the host.
        judged: the referee is called to a run that has ended.
        referee: takes the place of the task's.
    """
    if pause.kind != "break":
        runner.finish()
    result = outcome(runner, pause, meter, judged=judged, referee=referee)
    if folder is not None:
        folder.close()
        keep_pictures(folder.path / PICTURES, runner)
        for name, data in runner.kind.files(runner, pause, result).items():
            write_whole(folder.path / name, data)
        write_whole(folder.path / RESULT, to_json(result))
    return result
