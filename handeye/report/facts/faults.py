"""What was broken on purpose in the world of a run."""

from collections.abc import Iterator

from handeye.report.recorded import RecordedRun
from handeye.tasks import known


def told_faults(run: RecordedRun) -> Iterator[tuple[str, str]]:
    """Each fault as it would be typed, and what it does: a sentence, empty where its task is not known."""
    world = run.trace.head.world
    task = known(run.trace.head.task)
    for fault in world.faults:
        if task is None:
            yield str(fault), ""
        else:
            catalogue = task.faults(world.seed)
            yield catalogue.written(fault), catalogue.kind(fault.name).meaning
