"""Makes the photographs of docs/photographs.md from a recorded run, as docs/make_pictures.py makes all pictures.

handeye assemble --seed 15 --camera gl --out DIR
python docs/make_photographs.py DIR
"""

import re
import sys
from pathlib import Path
from typing import Any, Final

import cv2
import numpy as np

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

import handeye  # noqa: E402
from handeye.program.events import StepStarted  # noqa: E402

PICTURES = ROOT / "docs" / "pictures"
PAGE = ROOT / "docs" / "photographs.md"
WIDTH, HEIGHT = 800, 600
QUALITY = 82
SECOND, AFTER = 2, 0.8
"""Number (from 0) of the TOOL that drives the second screw, and the time (s) from its beginning to the photograph."""
DRIVING: Final[dict[str, tuple[str, dict[str, Any]]]] = {
    "studio_plain": ("studio", {}),
    "studio_fine": ("studio", {"fine": True}),
    "work_fine": ("work", {"fine": True}),
    "work_1973": ("work", {"film": "1973"}),
}
"""Photographs taken while a screw is driven: for each name, the camera and the settings."""
DONE: Final[dict[str, tuple[str, dict[str, Any]]]] = {
    "pump_plain": ("pump", {}),
    "pump_fine": ("pump", {"fine": True}),
}
"""Photographs taken at the end, likewise."""


def make(trace: "handeye.Trace") -> None:
    """Make all photographs; the page then names the moment at which the screw is driven."""
    started = [event for event in trace.events if isinstance(event, StepStarted)]
    tools = [event.time for event in started if event.text.startswith("TOOL")]
    moment = round(tools[SECOND] + AFTER, 1)
    for time, taken in ((moment, DRIVING), (trace.covers[1], DONE)):
        for name, (camera, how) in taken.items():
            picture = trace.frame(time, camera, width=WIDTH, height=HEIGHT, **how)
            bgr = np.ascontiguousarray(picture[:, :, ::-1])
            cv2.imwrite(str(PICTURES / f"{name}.webp"), bgr, [cv2.IMWRITE_WEBP_QUALITY, QUALITY])
    page = PAGE.read_text(encoding="utf-8")
    PAGE.write_text(re.sub(r"(--at |trace\.frame\()[\d.]+", rf"\g<1>{moment}", page), encoding="utf-8")


if __name__ == "__main__":
    make(handeye.open(sys.argv[1]))
