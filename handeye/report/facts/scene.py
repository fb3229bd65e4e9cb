"""Whether a run was made in the scene that its task has here."""

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadFile
from handeye.report.recorded import RecordedRun


def check_scene(run: RecordedRun) -> None:
    """Make sure that what moved in a run is in its scene; raises InvalidInput if it is not, or no task of that name is
    known here.
    """
    scene = run.trace.scene
    there = {scene.body(number).name for number in range(scene.nbody)}
    for begin in run.trace.times[:1]:
        for name in run.trace.at(float(begin)).poses:
            if name not in there:
                raise BadFile(f"{run.trace.name} is of another scene: here there is no {quoted(name)}")
