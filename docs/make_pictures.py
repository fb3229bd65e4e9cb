"""Makes the pictures of the README anew from a recorded run; `docs/plan.md` says how `pins.svg` is drawn.

handeye assemble --seed 15 --camera gl --out DIR
python docs/make_pictures.py DIR
"""

import sys
from pathlib import Path

import cv2
import numpy as np

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

import handeye  # noqa: E402

PICTURES = ROOT / "docs" / "pictures"
BIG, SEEN, SMALL = (1120, 840), (666, 512), (560, 420)
FASTER, FRAME, STILL = 40, 100, 2000
"""How many times as fast the film is; ms that a picture of it stands, and that its last does."""


def shrunk(name: str, picture: Path, size: tuple[int, int]) -> None:
    """A picture of the run, smaller."""
    image = cv2.resize(cv2.imread(str(picture)), size, interpolation=cv2.INTER_AREA)
    cv2.imwrite(str(PICTURES / name), image, [cv2.IMWRITE_PNG_COMPRESSION, 9])


def film(trace: "handeye.Trace") -> None:
    """The run from the studio, without the calibration before it."""
    begun, ends = trace.times[0] - trace.elapsed(trace.times[0]), trace.times[-1]
    times = [*np.arange(begun, ends, FASTER * FRAME / 1000), ends]
    frames = [trace.frame(time, width=SMALL[0], height=SMALL[1]) for time in times]
    animation = cv2.Animation()
    animation.frames = [cv2.cvtColor(np.ascontiguousarray(frame), cv2.COLOR_RGB2BGR) for frame in frames]
    animation.durations = np.array([FRAME] * (len(times) - 1) + [STILL], dtype=np.int32)
    cv2.imwriteanimation(str(PICTURES / "assembly.webp"), animation, [cv2.IMWRITE_WEBP_QUALITY, 60])


def main(run: Path) -> None:
    """All of them."""
    shrunk("workcell.png", run / "pictures" / "end_studio.png", BIG)
    shrunk("pump.png", run / "pictures" / "end_pump.png", BIG)
    shrunk("base_found.png", run / "pictures" / "close_up.png", SEEN)
    shrunk("gasket_checked.png", run / "pictures" / "after.png", SEEN)
    film(handeye.open(run))


if __name__ == "__main__":
    main(Path(sys.argv[1]))
