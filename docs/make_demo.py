"""Make the recorded runs that handeye includes.

python docs/make_demo.py [DIR]
python docs/make_demo.py chess
python docs/make_demo.py follow

Without a name, make the run that `handeye report --demo` shows: its thinned trace, its result, and a picture of its
end. DIR holds the run, kept by `handeye assemble --seed 15 --camera gl --out DIR`. Without DIR, the command first makes
the run. It needs OpenGL.

With the name of a job, make the run that `handeye demo JOB` shows: the record of one run of this job.
"""

import subprocess
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
RECORD = ("trace.mcap", "result.json")
OUTLINE = ("follow.json", "tables.gz", "result.json")  # a page of an outline needs no trace
JOBS = {
    "chess": (("sigma", "chess", "--pieces", "3", "--seed", "4"), RECORD),
    "follow": (("ml", "follow", "--outline", "L", "--seed", "3"), OUTLINE),
}


def make(run: Path) -> None:
    """Make all files of the pump."""
    (DEMO / "pictures").mkdir(parents=True, exist_ok=True)
    write_thinned(handeye.open(run), DEMO / "trace.mcap")
    (DEMO / "result.json").write_bytes((run / "result.json").read_bytes())
    shot = cv2.resize(cv2.imread(str(run / f"pictures/{PICTURE}.png")), SIZE, interpolation=cv2.INTER_AREA)
    cv2.imwrite(str(DEMO / f"pictures/{PICTURE}.webp"), shot, [cv2.IMWRITE_WEBP_QUALITY, 80])


def make_job(job: str, run: Path) -> None:
    """Make all files of a job."""
    (DEMO / job).mkdir(exist_ok=True)
    for name in JOBS[job][1]:
        (DEMO / job / name).write_bytes((run / name).read_bytes())


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as folder:
        run = Path(folder) / "run"
        if sys.argv[1:] and (job := sys.argv[1]) in JOBS:
            typed = [sys.executable, "-m", "handeye", *JOBS[job][0], "--out", str(run)]
            subprocess.run(typed, cwd=ROOT, check=True)  # noqa: S603 - fixed words
            make_job(job, run)
        elif sys.argv[1:]:
            make(Path(sys.argv[1]))
        else:
            handeye.assemble(seed=SEED, camera="gl", out=run)
            make(run)
