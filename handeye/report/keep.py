"""What a run leaves in a folder: plan, events, pictures, result."""

import os
from collections.abc import Iterable, Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Final

import cv2

from handeye.cell.photograph import photograph_png
from handeye.errors import InvalidInput
from handeye.files import write_whole
from handeye.plan.plan import Plan
from handeye.plan.store import encode
from handeye.report.result import to_json
from handeye.trials.assembly import Finished
from handeye.vision.drawing import annotate
from handeye.work.events import Event, to_line
from handeye.work.run import Found

PHOTOGRAPHS: Final = ("studio", "pump")
"""Cameras of the scene whose view of the end is kept."""


def make_folder(folder: Path) -> Path:
    """Make the folder and the one for its pictures, which is returned.

    Raises:
        InvalidInput: it cannot be made, or not be written to.
    """
    pictures = folder / "pictures"
    try:
        pictures.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise InvalidInput(f"{folder} cannot be made: {error.strerror}") from None
    if not os.access(pictures, os.W_OK):
        raise InvalidInput(f"{folder} cannot be written to")
    return pictures


@contextmanager
def kept_clean(folder: Path | None) -> Iterator[None]:
    """Find out before a run whether its folder can be had; a run that breaks off leaves no empty one behind.

    Raises:
        InvalidInput: as `make_folder`.
    """
    if folder is None:
        yield
        return
    made = [path for path in (folder / "pictures", folder, *folder.parents) if not path.exists()]
    make_folder(folder)
    try:
        yield
    except BaseException:
        for path in made:
            path.rmdir()
        raise


def keep(folder: Path, plan: Plan, events: Iterable[Event], finished: Finished) -> None:
    """Write `plan.json`, `events.jsonl`, `pictures/*.png` and `result.json`, each whole or not at all.

    The pictures are those the program took, with what it found in them, and photographs of the end where there
    is OpenGL.

    Raises:
        InvalidInput: the folder cannot be made or written to.
    """
    pictures = make_folder(folder)
    write_whole(folder / "plan.json", encode(plan).encode())
    write_whole(folder / "events.jsonl", b"".join(to_line(event) for event in events))
    run = finished.run
    for name, shot in run.shots.items():
        found = run.found.get(name, Found())
        image = annotate(
            shot.picture, general=found.general, specific=found.specific, inspection=found.inspection
        )
        done, data = cv2.imencode(".png", image)
        assert done
        write_whole(pictures / f"{name.lower()}.png", data.tobytes())
    if finished.cell.camera.renderer.startswith("OpenGL"):
        for camera in PHOTOGRAPHS:
            write_whole(
                pictures / f"end_{camera}.png", photograph_png(finished.cell.truth, camera, 1280, 960)
            )
    write_whole(folder / "result.json", to_json(finished.result))
