"""Records the host time of a run over all its sessions, in a separate file of the run's folder.

Because the file is separate, the checkpoints and traces of equal runs are equal byte for byte.
"""

from dataclasses import dataclass, field
from pathlib import Path

import msgspec

from handeye.core.errors import BadFile
from handeye.core.files import read_whole, write_whole
from handeye.core.host_time import HostTimer
from handeye.core.record import Record
from handeye.runs.runner import Runner

_LARGEST = 10_000  # bytes of the file


class HostSeconds(Record, frozen=True, kw_only=True):
    """Host time of a run, summed over its sessions. A session is one process that began or resumed the run."""

    planning_cpu_s: float = 0.0  # 0: the plan existed already
    vision_cpu_s: float = 0.0  # including steps that were undone later
    run_cpu_s: float = 0.0
    run_wall_s: float = 0.0
    """Wall-clock time from the loading of the command, or from the call in Python, to the verdict. It includes the
    time spent waiting for the user.
    """
    from_step: int = 0  # steps done before the first session that is counted
    from_clock_s: float = 0.0  # the clock when that session began: below 0 if the session prepared the cell


@dataclass(slots=True, kw_only=True)
class Meter:
    """Measures the host time of a session, and adds it to the time of earlier sessions."""

    timer: HostTimer = field(default_factory=HostTimer)
    planning_cpu_s: float = 0.0
    before: HostSeconds | None = None

    def seconds(self, runner: Runner) -> HostSeconds:
        """Return the host time of the run so far."""
        before = self.before or HostSeconds(from_step=runner.first, from_clock_s=runner.started)
        return msgspec.structs.replace(
            before,
            planning_cpu_s=round(before.planning_cpu_s + self.planning_cpu_s, 3),
            vision_cpu_s=round(before.vision_cpu_s + runner.vision.seconds, 3),
            run_cpu_s=round(before.run_cpu_s + self.timer.cpu_s, 3),
            run_wall_s=round(before.run_wall_s + self.timer.wall_s, 3),
        )


def read_host_seconds(path: Path) -> HostSeconds | None:
    """Read the host time of earlier sessions. Returns None if there is no record. Raises BadFile if the record
    is not valid."""
    if not path.exists():
        return None
    try:
        found = msgspec.json.decode(read_whole(path, _LARGEST), type=HostSeconds)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise BadFile(f"{path} is not a timing record: {error}") from None
    if min(msgspec.structs.astuple(msgspec.structs.replace(found, from_clock_s=0.0))) < 0:
        raise BadFile(f"{path} is not a timing record: a time is negative")
    return found


def write_host_seconds(path: Path, seconds: HostSeconds) -> None:
    """Write the host time atomically: either the whole file is written, or nothing."""
    write_whole(path, msgspec.json.format(msgspec.json.encode(seconds), indent=1) + b"\n")
