"""Writes the pictures in a run's folder. The folder has each picture that the program took, with the detected features
drawn over it, and photographs of the finished work.
"""

from contextlib import suppress
from pathlib import Path
from typing import Final

import cv2
import numpy as np
from numpy.typing import NDArray

from handeye.cell.photograph import png, smooth_photographs
from handeye.cell.posed import as_it_stands
from handeye.core.errors import BadFile, CannotWrite, Refused
from handeye.core.files import write_whole
from handeye.runs.runner import Runner
from handeye.runs.system import RunningSystem
from handeye.runs.systems import written
from handeye.vision.drawing import annotate

_WIDE: Final = 480
_QUALITY: Final = 70


def annotated_png(system: RunningSystem, name: str) -> bytes:
    """Return a picture with the detected features drawn over it, as a PNG file. Raises InvalidInput if the
    features lie too far outside the picture.
    """
    done, data = cv2.imencode(".png", _annotated(system, name))
    assert done
    return data.tobytes()


def annotated_webp(system: RunningSystem, name: str) -> bytes:
    """Return a picture with the detected features drawn over it, as a small WebP file for pages."""
    image = _annotated(system, name)
    high = round(_WIDE * image.shape[0] / image.shape[1])
    small = cv2.resize(image, (_WIDE, high), interpolation=cv2.INTER_AREA)
    done, data = cv2.imencode(".webp", small, [cv2.IMWRITE_WEBP_QUALITY, _QUALITY])
    assert done
    return data.tobytes()


def _annotated(system: RunningSystem, name: str) -> NDArray[np.uint8]:
    try:
        return annotate(system.shots[name].picture, list(system.marks(name)))
    except ValueError:
        raise BadFile(f"the findings in picture {name} cannot be drawn") from None


def keep_pictures(folder: Path, runner: Runner, *, photographs: bool = True) -> None:
    """Write the program's pictures and, if OpenGL is available, photographs of the cell. Raises InvalidInput if a
    picture cannot be written.
    """
    try:
        folder.mkdir(exist_ok=True)  # an empty folder is easily lost when a run is copied
    except OSError as error:
        raise CannotWrite(f"the folder {folder} cannot be created: {error.strerror}") from None
    for name in runner.system.shots:
        write_whole(folder / f"{name.lower()}.png", annotated_png(runner.system, name))
    if runner.system.cell is None or not photographs:
        return
    if runner.cell.renderer.method == "opengl" and runner.task.photographs:
        posed = as_it_stands(runner.task.shown(runner.setup.world, written(runner.setup)), runner.cell.truth)
        cameras = runner.task.photographs
        taken = smooth_photographs(*posed, cameras=cameras, width=1280, height=960)
        with suppress(Refused):  # OpenGL may lack the memory for pictures larger than the camera's
            for camera, picture in zip(cameras, taken, strict=True):
                write_whole(folder / f"end_{camera}.png", png(picture))
