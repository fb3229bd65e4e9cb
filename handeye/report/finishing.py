"""The end of a run, or a pause in it: account, verdict, pictures and result."""

from handeye.files import write_whole
from handeye.report.judging import findings
from handeye.report.pictures import keep_pictures
from handeye.report.result import Result, to_json
from handeye.report.summary import summary
from handeye.runs.advance import Pause
from handeye.runs.folder import PICTURES, RESULT, RunFolder
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner


def finished(
    runner: Runner, pause: Pause, meter: Meter, *, judged: bool, folder: RunFolder | None = None
) -> Result:
    """Finish a run, unless it only pauses; its result, which is kept in its folder with the pictures.

    Args:
        meter: measures what the run costs the host.
        judged: the referee is called to a run that has ended.

    Raises:
        InvalidInput: the folder cannot be written to.
    """
    over = pause.kind != "break"
    if over:
        runner.finish()
    found = findings(runner, pause) if judged and over else None
    result = summary(runner, pause, findings=found, host=meter.seconds(runner))
    if folder is not None:
        folder.close()
        keep_pictures(folder.path / PICTURES, runner)
        write_whole(folder.path / RESULT, to_json(result))
    return result
