"""Warns that the result of a resumed run may differ from the result of an uninterrupted run, and says why."""

from collections.abc import Iterator

from handeye.core.files import unguarded
from handeye.core.versions import versions
from handeye.program.events import RunStarted
from handeye.runs.folder import EVENTS, RunFolder
from handeye.runs.runner import Runner
from handeye.trace.sentences import renderer_name


def cautions(runner: Runner, *, judged: bool) -> Iterator[str]:
    """Yield a sentence for each circumstance that has changed since the run began, such as the renderer or a version.
    A further sentence says so if the camera calibration could not be saved.
    """
    if runner.system.unkept is not None:
        yield f"the camera calibration was not kept for other runs: {runner.system.unkept}"
    begun = next((event for event in runner.events if isinstance(event, RunStarted)), None)
    if begun is None:
        return
    here = None if runner.system.cell is None else runner.cell.renderer
    if here is not None and begun.camera != here:
        yield f"the run began with the renderer {renderer_name(begun.camera)}; now the run uses {renderer_name(here)}"
    changed = [name for name, version in versions().items() if begun.versions.get(name) != version]
    if changed:
        yield f"the run began with other versions of {', '.join(changed)}; the result may differ"
    referee = runner.setup.replaced.get("referee")
    if judged and referee is not None:
        yield (
            f"the run began with `{referee}`, a referee of the calling program; the run does not contain the code "
            "of this referee, so the referee of the task now judges the run"
        )


def losses(folder: RunFolder, runner: Runner) -> Iterator[str]:
    """Yield sentences on the damage to the folder of a resumed run: a lost trace, or a lost event list. If other
    commands may also write to the folder during the run, a sentence says so.
    """
    if folder.unlocked:
        yield unguarded(folder.path, folder.unlocked)
    if folder.lost:
        yield (
            f"the old trace in {folder.path} was lost or damaged: the new trace does not contain the motions before "
            f"{runner.time:.2f} s"
        )
    if folder.journal_lost:
        yield (
            f"the event list {folder.path / EVENTS} was lost, was damaged, or belonged to another run; the new list "
            "starts from the checkpoint, and lacks the steps that were undone earlier"
        )
