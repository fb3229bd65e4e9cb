"""Makes the photographs of docs/photographs.md anew from a recorded run; docs/make_pictures.py makes them too.

handeye assemble --seed 15 --camera gl --out DIR
python docs/make_photographs.py DIR
"""

import sys
from pathlib import Path
from typing import Any, Final

import cv2
import numpy as np

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

import handeye  # noqa: E402

PICTURES = ROOT / "docs" / "pictures"
WIDTH, HEIGHT = 800, 600
QUALITY = 90
DRIVING, END = 288.0, 427.4
"""Seconds since the run began: a screw is driven; all is done."""
TAKEN: Final[dict[str, tuple[float, str, dict[str, Any]]]] = {
    "studio_plain": (DRIVING, "studio", {}),
    "studio_fine": (DRIVING, "studio", {"fine": True}),
    "pump_plain": (END, "pump", {}),
    "pump_fine": (END, "pump", {"fine": True}),
    "work_fine": (DRIVING, "work", {"fine": True}),
    "work_1973": (DRIVING, "work", {"film": "1973"}),
}
"""When, by which camera, and how."""


def make(trace: "handeye.Trace") -> None:
    """All of them."""
    for name, (at, camera, how) in TAKEN.items():
        picture = trace.frame(trace.head.time + at, camera, width=WIDTH, height=HEIGHT, **how)
        bgr = np.ascontiguousarray(picture[:, :, ::-1])
        cv2.imwrite(str(PICTURES / f"{name}.webp"), bgr, [cv2.IMWRITE_WEBP_QUALITY, QUALITY])


if __name__ == "__main__":
    make(handeye.open(sys.argv[1]))
