"""Pictures of the cell as PNG."""

import cv2

from handeye.cell.imperfection import World
from handeye.cell.photograph import photograph
from handeye.cell.simulated import SimulatedCell
from handeye.cell.truth import Truth


def picture(*, camera: str, width: int, height: int, seed: int) -> bytes:
    """The cell of a seed before work begins.

    Raises:
        InvalidInput: no such camera, an unusable size, or no OpenGL.
    """
    return photograph_png(SimulatedCell(World.sample(seed), camera="ray").truth, camera, width, height)


def photograph_png(truth: Truth, camera: str, width: int, height: int) -> bytes:
    """The cell as it is now, drawn at twice the size and averaged."""
    fine = photograph(truth.model, truth.data, camera=camera, width=2 * width, height=2 * height)
    smooth = cv2.resize(fine, (width, height), interpolation=cv2.INTER_AREA)
    done, png = cv2.imencode(".png", smooth[:, :, ::-1])
    assert done
    return png.tobytes()
