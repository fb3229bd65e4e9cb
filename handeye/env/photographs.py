"""Photographs of an episode, for the user: no policy sees them."""

from handeye.cell.photograph import Photograph, photograph
from handeye.runs.runner import Runner

_WIDTH, _HEIGHT = 640, 480


def photographed(runner: Runner) -> Photograph:
    """Return a photograph of the cell as it is now, shape (height, width, 3). Raises InvalidInput if OpenGL is
    missing.
    """
    truth = runner.cell.truth
    return photograph(truth.model, truth.data, camera=runner.task.camera, width=_WIDTH, height=_HEIGHT).copy()
