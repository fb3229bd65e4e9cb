"""Make the run that `handeye report --demo` shows: its thinned trace, its result, and a picture of its end.

python docs/make_demo.py [DIR]

DIR holds the run, kept by `handeye assemble --seed 15 --camera gl --out DIR`. Without DIR, the command first makes the
run. It needs OpenGL.
"""

import sys
import tempfile
from pathlib import Path

import cv2

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

import handeye  # noqa: E402
from handeye.trace.thinning import write_thinned  # noqa: E402

DEMO = ROOT / "demo"
SEED = 15
PICTURE = "end_pump"
SIZE = (960, 720)


def make(run: Path) -> None:
    """Make all files."""
    (DEMO / "pictures").mkdir(parents=True, exist_ok=True)
    write_thinned(handeye.open(run), DEMO / "trace.mcap")
    (DEMO / "result.json").write_bytes((run / "result.json").read_bytes())
    shot = cv2.resize(cv2.imread(str(run / f"pictures/{PICTURE}.png")), SIZE, interpolation=cv2.INTER_AREA)
    cv2.imwrite(str(DEMO / f"pictures/{PICTURE}.webp"), shot, [cv2.IMWRITE_WEBP_QUALITY, 80])


if __name__ == "__main__":
    if sys.argv[1:]:
        make(Path(sys.argv[1]))
    else:
        with tempfile.TemporaryDirectory() as folder:
            run = Path(folder) / "pump"
            handeye.assemble(seed=SEED, camera="gl", out=run)
            make(run)
