"""The result of a run as it pauses: account and verdict. Nothing is done to the run, and nothing is kept."""

import msgspec
from msgspec import UNSET

from handeye.results.judging import Referee, findings
from handeye.results.result import Result
from handeye.results.summary import summary
from handeye.runs.advance import Pause
from handeye.runs.host_seconds import Meter
from handeye.runs.parts import deciding, name_of
from handeye.runs.runner import Runner


def outcome(
    runner: Runner, pause: Pause, meter: Meter, *, judged: bool, referee: Referee | None = None
) -> Result:
    """The result of a run as it pauses.

    Args:
        meter: measures what the run costs the host.
        judged: the referee is called to a run that has ended, if it acts on a cell.
        referee: takes the place of the task's.
    """
    asked = judged and pause.kind != "break" and runner.system.cell is not None
    found = findings(runner, pause, referee) if asked else None
    built = runner.system.built() if asked and runner.undone else {}
    result = summary(runner, pause, findings=found, built=built, host=meter.seconds(runner))
    others = deciding(runner.setup.replaced) | ({} if referee is None else {"referee": name_of(referee)})
    limits = runner.setup.limits if found is not None and referee is None else None
    return msgspec.structs.replace(
        result, limits=limits or UNSET, replaced=others or UNSET, without=runner.setup.without or UNSET
    )
