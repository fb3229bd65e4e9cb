"""The end of a run, or a pause in it: account, verdict, pictures and result."""

import msgspec
from msgspec import UNSET

from handeye.files import write_whole
from handeye.report.judging import Referee, findings, findings_built
from handeye.report.pictures import keep_pictures
from handeye.report.result import Result, to_json
from handeye.report.summary import summary
from handeye.runs.advance import Pause
from handeye.runs.folder import PICTURES, RESULT, RunFolder
from handeye.runs.host_seconds import Meter
from handeye.runs.parts import deciding, name_of
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

    Args:
        meter: measures what the run costs the host.
        judged: the referee is called to a run that has ended.
        referee: takes the place of the task's.

    Raises:
        InvalidInput: the folder cannot be written to.
    """
    if pause.kind != "break":
        runner.finish()
    result = outcome(runner, pause, meter, judged=judged, referee=referee)
    if folder is not None:
        folder.close()
        keep_pictures(folder.path / PICTURES, runner)
        write_whole(folder.path / RESULT, to_json(result))
    return result


def outcome(
    runner: Runner, pause: Pause, meter: Meter, *, judged: bool, referee: Referee | None = None
) -> Result:
    """The result of a run as it pauses, which nothing is done to; arguments are those of `finished`."""
    asked = judged and pause.kind != "break"
    found = findings(runner, pause, referee) if asked else None
    built = findings_built(runner) if asked else {}
    result = summary(runner, pause, findings=found, built=built, host=meter.seconds(runner))
    others = deciding(runner.setup.replaced) | ({} if referee is None else {"referee": name_of(referee)})
    limits = runner.setup.limits if found is not None and referee is None else None
    return msgspec.structs.replace(
        result, limits=limits or UNSET, replaced=others or UNSET, without=runner.setup.without or UNSET
    )
