"""Make the pictures of docs/, with these exceptions. `make_readme_pictures.py` makes those of the README, and
`make_report_picture.py` makes `report.webp`. `pipeline.svg` is drawn by hand. docs/dismantling.md, docs/trig.md,
docs/chess.md and docs/proof.md say how to make `apart.webp`, `palletiser*.webp`, `chess.webp` and `proof.svg`.

python docs/make_pictures.py [DIR]

DIR holds the run to show, kept by `handeye assemble --seed 15 --camera gl --out DIR`. Without DIR, the command first
makes the run. It needs OpenGL.
"""

import sys
import tempfile
from pathlib import Path

import cv2

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

import make_photographs  # noqa: E402

import handeye  # noqa: E402
from handeye.inspection.drawing import flow_svg  # noqa: E402
from handeye.inspection.flow import flow  # noqa: E402
from handeye.planfile.store import read_plan  # noqa: E402

PICTURES = ROOT / "docs" / "pictures"
SEED = 15
PINS = 4
"""The stage whose flow is drawn."""
BIG, SEEN = (1096, 822), (666, 512)


def kept(name: str, picture: Path, size: tuple[int, int]) -> None:
    """A picture that the run has kept, made smaller."""
    image = cv2.resize(cv2.imread(str(picture)), size, interpolation=cv2.INTER_AREA)
    cv2.imwrite(str(PICTURES / name), image, [cv2.IMWRITE_PNG_COMPRESSION, 9])


def photographed(name: str, trace: "handeye.Trace", camera: str) -> None:
    """A photograph of the cell at the end of the run."""
    width, height = BIG
    picture = trace.frame(trace.times[-1], camera, width=width, height=height, fine=True)
    cv2.imwrite(str(PICTURES / name), picture[:, :, ::-1], [cv2.IMWRITE_PNG_COMPRESSION, 9])


def drawn(name: str, stage: int) -> None:
    """The flow of a stage of the plan."""
    plan = read_plan(ROOT / "plans" / "water_pump.plan.json")
    (PICTURES / name).write_text(flow_svg(flow(plan, stage)), encoding="utf-8")


def make(run: Path) -> None:
    """Make all pictures."""
    trace = handeye.open(run)
    photographed("workcell.png", trace, "studio")
    photographed("pump.png", trace, "pump")
    kept("base_found.png", run / "pictures" / "close_up.png", SEEN)
    kept("gasket_checked.png", run / "pictures" / "after.png", SEEN)
    make_photographs.make(trace)
    drawn("pins.svg", PINS)


def main(words: list[str]) -> None:
    """Make the pictures of the named run, or of a new run."""
    if words:
        make(Path(words[0]))
        return
    with tempfile.TemporaryDirectory(prefix="handeye-") as folder:
        run = Path(folder) / "run"
        handeye.assemble(seed=SEED, camera="gl", out=run)
        make(run)


if __name__ == "__main__":
    main(sys.argv[1:])
