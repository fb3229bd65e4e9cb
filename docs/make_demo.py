"""Make the recorded runs of the gallery.

python docs/make_demo.py [DIR]
python docs/make_demo.py NAME

Without a name, make the run that `handeye report --demo` shows: its thinned trace, its result, and a picture of its
end. DIR holds the run, kept by `handeye assemble --seed 15 --camera gl --out DIR`. Without DIR, the command first makes
the run. It needs OpenGL.

With the name of a recording, such as `chess` or `silent_failure`, make this recording. Those in `demo/` are included
with handeye, for `handeye demo NAME`. Those in `docs/recordings/` are only on the site of the documentation.
"""

import subprocess
import sys
import tempfile
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path

import cv2

ROOT = Path(__file__).parent.parent
sys.path.insert(0, str(ROOT))

import handeye  # noqa: E402
from handeye.trace.channels import EVENTS, MACHINES  # noqa: E402
from handeye.trace.mcap_writer import GrowingFile  # noqa: E402
from handeye.trace.thinning import write_thinned  # noqa: E402

DEMO = ROOT / "demo"
GALLERY = ROOT / "docs" / "recordings"
SEED = 15
PICTURE = "end_pump"
SIZE = (960, 720)
TRACE = "trace.mcap"
RESULT = "result.json"


def typed(words: str, out: Path) -> None:
    """Carry out a command of handeye that keeps its run in `out`. A run may stop, and so the exit code may be 1."""
    subprocess.run(  # noqa: S603 - fixed words
        [sys.executable, "-m", "handeye", *words.split(), "--out", str(out)], cwd=ROOT, check=False
    )


def kept(words: str) -> Callable[[Path], None]:
    """Return a function that makes a run by a command."""
    return lambda run: typed(words, run)


def fail_silently(run: Path) -> None:
    """Let the program with which the exercise `honest` begins look for a hole that is out of reach."""
    handeye.assemble(
        script=ROOT / "plans/exercises/honest.al",
        taught=ROOT / "plans/insertion.toml",
        task="insertion",
        world=handeye.World(10, set={"plate.x": 20, "plate.y": 0}, task="insertion"),
        out=run,
    )


def take_apart(run: Path) -> None:
    """Put the pump together up to its top, and record only how the arm takes it apart."""
    built = run.with_name("built")
    typed("run plans/water_pump.plan.json --seed 0 --camera gl --to 7", built)
    typed(f"dismantle {built}", run)


def write_account(trace: handeye.Trace, path: Path) -> None:
    """Write a trace for a page without a replay in 3D: what happened, and the channels, but no motions and pictures."""
    thinned = path.with_name("thinned.mcap")
    write_thinned(trace, thinned)
    file = GrowingFile(path)
    try:
        file.begin(trace.head, trace.plan, thinned=True)
        for message in handeye.open(thinned).messages:
            if message.topic in (EVENTS, MACHINES):
                file.write(message.topic, message.time, message.data)
        file.finish()
    finally:
        file.release()
        thinned.unlink()


@dataclass(frozen=True)
class Recording:
    """A recorded run: its folder, how the run is made, and what is kept of it."""

    folder: Path
    run: Callable[[Path], None]
    files: tuple[str, ...] = (RESULT,)  # kept as they are
    thin: Callable[[handeye.Trace, Path], object] | None = None  # writes what is kept of the trace


RECORDINGS = {
    "chess": Recording(DEMO, kept("sigma chess --pieces 3 --seed 4"), (TRACE, RESULT)),
    "follow": Recording(
        DEMO, kept("ml follow --outline L --seed 3"), ("follow.json", "tables.gz", RESULT)
    ),  # a page of an outline needs no trace
    "doubled_gasket": Recording(
        GALLERY,
        kept("assemble --seed 731905 --fault gasket.doubled --on-stop abort --camera gl"),
        thin=write_thinned,
    ),
    "silent_failure": Recording(GALLERY, fail_silently, thin=write_thinned),
    "dismantling": Recording(GALLERY, take_apart, thin=write_thinned),
    "palletiser": Recording(
        GALLERY, kept("trig palletise --blocks 6 --seed 4"), ("job.json", "program.trig.json", RESULT)
    ),  # nor does a page of blocks
    "rail_support": Recording(GALLERY, kept("ml support"), ("tables.gz", RESULT), thin=write_account),
    "four_languages": Recording(
        GALLERY, kept("relay plans/four_languages.relay --seed 962203 --camera gl"), thin=write_account
    ),
}


def make(run: Path) -> None:
    """Make all files of the pump."""
    (DEMO / "pictures").mkdir(parents=True, exist_ok=True)
    write_thinned(handeye.open(run), DEMO / TRACE)
    (DEMO / RESULT).write_bytes((run / RESULT).read_bytes())
    shot = cv2.resize(cv2.imread(str(run / f"pictures/{PICTURE}.png")), SIZE, interpolation=cv2.INTER_AREA)
    cv2.imwrite(str(DEMO / f"pictures/{PICTURE}.webp"), shot, [cv2.IMWRITE_WEBP_QUALITY, 80])


def make_recording(name: str, run: Path) -> None:
    """Make all files of another recording from its kept run."""
    recording = RECORDINGS[name]
    folder = recording.folder / name
    folder.mkdir(parents=True, exist_ok=True)
    for file in recording.files:
        (folder / file).write_bytes((run / file).read_bytes())
    if recording.thin is not None:
        recording.thin(handeye.open(run), folder / TRACE)


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as temporary:
        run = Path(temporary) / "run"
        if sys.argv[1:] and (name := sys.argv[1]) in RECORDINGS:
            RECORDINGS[name].run(run)
            make_recording(name, run)
        elif sys.argv[1:]:
            make(Path(sys.argv[1]))
        else:
            handeye.assemble(seed=SEED, camera="gl", out=run)
            make(run)
