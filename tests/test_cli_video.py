"""`handeye video`: a film of a run, or one sentence on why there is none."""

import shutil
import sys
from collections.abc import Callable
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from conftest import Command
from recordings import BODIES, record
from short_runs import begin, through

import handeye
from handeye.cell.photograph import Near
from handeye.core.errors import InvalidInput
from handeye.runs.folder import open_new
from handeye.runs.runner import Runner
from handeye.trace import channels, mcap_writer
from handeye.video import making

pytestmark = pytest.mark.slow

Planned = Callable[[str], str]


class FakePhotographer:
    """Draws a level of grey for each frame."""

    def __init__(self, scene: object, *, width: int, height: int, shadow: int) -> None:
        self.size, self.taken = (height, width, 3), 0

    def take(self, model: object, data: object, view: str | Near) -> np.ndarray:
        self.taken += 1
        return np.full(self.size, self.taken % 256, dtype=np.uint8)


@pytest.fixture(autouse=True)
def no_opengl_needed(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(making, "Photographer", FakePhotographer)


@pytest.fixture(scope="module")
def recorded(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """The folder of a run of two stages."""
    start, path = (
        begin('STAGE "open"\nOPEN 1\nSTAGE "shut"\nOPEN 2'),
        tmp_path_factory.mktemp("video") / "run",
    )
    folder = open_new(path, start)
    through(Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)])).finish()
    folder.close()
    return path


@pytest.fixture
def kept(command: Command, recorded: Path) -> Path:
    """A copy of it, in the folder that commands are given in."""
    return Path(shutil.copytree(recorded, "kept"))


SMALL = ("--size", "64x48", "--seconds", "1")


def refused(command: Command, *words: str) -> str:
    """The sentence with which a command is refused, which leaves nothing behind."""
    before = {path for path in Path().rglob("*") if path.suffix != ".mcap"}
    code, out, err = command("video", *words)
    assert (code, out) == (2, "")
    assert {path for path in Path().rglob("*") if path.suffix != ".mcap"} == before
    return err.removeprefix("handeye: ").rstrip("\n")


def test_the_folder_of_a_run_gets_its_video(command: Command, kept: Path) -> None:
    code, out, err = command("video", "kept", *SMALL)
    assert (code, out) == (0, "kept/video.webp: 1.0 s, 11 frames of 64 x 48, 0.00 MB\n")
    assert err == "drawing frame 1 of 11\n"
    _, animation = cv2.imreadanimation("kept/video.webp")
    assert sum(np.array(animation.durations)) == 1000


def test_the_same_trace_gives_the_same_video(command: Command, kept: Path) -> None:
    for name in ("one.webp", "other.webp", "one.webm", "other.webm"):
        assert command("video", "kept", "-o", name, "--captions", *SMALL)[0] == 0
    assert Path("one.webp").read_bytes() == Path("other.webp").read_bytes()
    assert Path("one.webm").read_bytes() == Path("other.webm").read_bytes()


def test_an_mp4_is_the_same_twice_and_has_all_frames(command: Command, kept: Path) -> None:
    pytest.importorskip("av", reason="the extra `mp4` is not installed")
    said = [command("video", "kept", "-o", name, *SMALL)[1] for name in ("one.mp4", "other.mp4")]
    assert Path("one.mp4").read_bytes() == Path("other.mp4").read_bytes()
    shown = cv2.VideoCapture("one.mp4")
    frames, width, rate = map(
        shown.get, (cv2.CAP_PROP_FRAME_COUNT, cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FPS)
    )
    assert (width, rate) == (64, 12)
    assert said[0].startswith(f"one.mp4: {frames / rate:.1f} s, ")


def test_without_the_extra_there_is_no_mp4_and_nothing_is_drawn(
    command: Command, kept: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "av", None)
    assert refused(command, "kept", "-o", "it.mp4") == (
        "`video -o FILE.mp4` needs av, which is not installed: `pip install av` installs it, and so does the "
        "extra `mp4` of handeye"
    )


def test_it_is_made_from_python_too(kept: Path) -> None:
    made = handeye.open(kept).video("it.webp", width=64, height=48, speed=0.5, first=1, last="open")
    assert (made.path, made.bytes) == (Path("it.webp"), Path("it.webp").stat().st_size)


def test_python_is_told_its_own_word_for_replacing_one(kept: Path) -> None:
    handeye.open(kept).video("it.webp", width=64, height=48, speed=0.5, first=1, last="open")
    with pytest.raises(InvalidInput, match=r"^it\.webp already exists; overwrite=True replaces it$"):
        handeye.open(kept).video("it.webp")


@pytest.mark.parametrize(
    ("wrong", "sentence"),
    [
        ({"first": True}, "give a stage by its number or its name, not by True"),
        ({"camera": 3}, "give the name of a camera, not 3"),
        ({"seconds": "14"}, "the length of a video must be more than 0 and at most 600 s, not 14 s"),
        ({"width": 64.5}, "a video of 64.5 x 360 cannot be made; each side must have 8 to 2048 pixels"),
        ({"path": 7}, "the name of a video must end in .webp, .webm or .mp4, not 7"),
    ],
)
def test_a_wrong_argument_is_told_in_a_sentence(kept: Path, wrong: dict[str, Any], sentence: str) -> None:
    with pytest.raises(InvalidInput) as told:
        handeye.open(kept).video(**{"path": "it.webp", **wrong})
    assert str(told.value) == sentence


REFUSALS = {
    ("--size", "480"): "`480` is not a size; write it like 480x360",
    ("--size", "4x4"): "a video of 4 x 4 cannot be made; each side must have 8 to 2048 pixels",
    ("--seconds", "0"): "the length of a video must be more than 0 and at most 600 s, not 0.0 s",
    (
        "--speed",
        "nan",
    ): "the speed of a video, as a multiple of the speed of the run, must be above 0, not nan",
    (
        "--speed",
        "2",
        "--seconds",
        "2",
    ): "give either the length or the speed of a video, not both: each determines the other",
    ("--speed", "1e-9"): "at 1e-09 times the speed of the run, the video would take ",
    (
        "--camera",
        "nowhere",
    ): "there is no camera nowhere; the cameras are orbit, follow, tv, studio, pump, work, belt",
    ("--from", "shutt"): "there is no stage `shutt`; did you mean `shut`?",
    ("--to", "3"): "there is no stage 3; the program has stages 1 to 2",
    ("--from", "shut", "--to", "open"): "the last stage, `open`, comes before the first, `shut`",
    (
        "-o",
        "it.webm",
        "--size",
        "65x48",
    ): "a WebM video of 65 x 48 cannot be made; width and height must be even",
    ("-o", "it.gif"): "it.gif: a GIF would be seven times as large as a WebP picture, with only 256 colours",
    ("-o", "nowhere/it.webp"): "nowhere/it.webp cannot be written: No such file or directory",
}


@pytest.mark.parametrize("words", REFUSALS, ids=" ".join)
def test_what_there_cannot_be_is_told_in_a_sentence(
    command: Command, kept: Path, words: tuple[str, ...]
) -> None:
    assert refused(command, "kept", *words).startswith(REFUSALS[words])


def test_a_video_in_the_folder_of_its_run_is_renewed_and_one_elsewhere_only_on_request(
    command: Command, kept: Path
) -> None:
    assert command("video", "kept", *SMALL)[0] == 0
    shutil.copy(kept / "video.webp", "it.webp")
    assert command("video", "kept", *SMALL)[1].endswith("; the earlier file is replaced\n")
    said = refused(command, "kept", "-o", "it.webp", *SMALL)
    assert said == "it.webp already exists; --overwrite replaces it"


def test_a_file_of_somebody_is_left_alone(command: Command, kept: Path) -> None:
    Path("it.webm").write_text("mine", encoding="utf-8")
    assert refused(command, "kept", "-o", "it.webm", "--overwrite") == (
        "it.webm exists and is not a WebM video; nothing was written"
    )


def test_a_run_that_takes_the_place_of_another_takes_its_video_away(
    command: Command, planned: Planned, kept: Path
) -> None:
    assert command("video", "kept", *SMALL)[0] == 0
    assert command("run", planned("OPEN 1"), "--camera", "ray", "--out", "kept", "--overwrite")[0] == 0
    assert not (kept / "video.webp").exists()


def test_a_run_that_goes_on_loses_the_video_of_what_it_was(command: Command, planned: Planned) -> None:
    plan = planned('STAGE "one"\nOPEN 1\nSTAGE "two"\nOPEN 2')
    assert command("run", plan, "--camera", "ray", "--out", "kept", "--to", "one")[0] == 0
    assert command("video", "kept", *SMALL)[0] == 0
    assert refused(command, "kept", "-o", "it.webp", "--from", "two") == (
        "kept/trace.mcap does not show stage `two`; it shows `one`"
    )
    assert command("resume", "kept")[0] == 0
    assert not Path("kept/video.webp").exists()


def test_a_folder_without_a_run(command: Command) -> None:
    Path("empty").mkdir()
    assert refused(command, "empty") == "empty holds no run"


def test_what_there_is_not(command: Command) -> None:
    assert refused(command, "nowhere") == "nowhere: there is no such file"


def test_a_run_taken_up_from_a_checkpoint_shows_what_was_recorded(command: Command, planned: Planned) -> None:
    plan = planned('STAGE "one"\nOPEN 1\nSTAGE "two"\nOPEN 2')
    ray = ("--camera", "ray")
    assert command("run", plan, *ray, "--checkpoints", "kept", "--to", "one")[0] == 0
    assert command("run", plan, *ray, "--checkpoints", "kept", "--from", "two", "--out", "it")[0] == 0
    assert command("video", "it", *SMALL)[0] == 0
    assert refused(command, "it", "--from", "one", "-o", "one.webp") == (
        "it/trace.mcap does not show stage `one`; it shows `two`"
    )


def test_an_event_list_does_not_say_where_things_were(command: Command) -> None:
    Path("events.jsonl").write_text("", encoding="utf-8")
    assert refused(command, "events.jsonl") == (
        "events.jsonl is an event list, which holds no positions; use the trace.mcap"
    )


def test_a_trace_of_a_newer_version(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    with monkeypatch.context() as patch:
        patch.setattr(mcap_writer, "VERSION", channels.VERSION + 1)
        record(Path("new.mcap"))
    assert refused(command, "new.mcap").startswith("new.mcap has trace format version 5")


def test_a_trace_of_another_scene(command: Command) -> None:
    record(Path("other.mcap"))
    assert f"`{BODIES[1]}`" in refused(command, "other.mcap")


def test_a_trace_that_was_cut_short_is_shown_as_far_as_it_goes(command: Command, kept: Path) -> None:
    data = (kept / "trace.mcap").read_bytes()
    Path("cut.mcap").write_bytes(data[: len(data) - 40])
    code, _, err = command("video", "cut.mcap", *SMALL)
    assert (code, err.splitlines()[0]) == (
        0,
        "cut.mcap was cut short; the video shows only the recorded part",
    )


@pytest.mark.parametrize("name", ["it.webp", "it.webm"])
def test_one_that_is_interrupted_leaves_nothing(
    command: Command, kept: Path, monkeypatch: pytest.MonkeyPatch, name: str
) -> None:
    def interrupt(*_: object) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr(FakePhotographer, "take", interrupt)
    before = {*Path().rglob("*")}
    assert command("video", "kept", "-o", name, *SMALL)[0] == 130
    assert {*Path().rglob("*")} == before


def test_without_opengl_there_is_none(command: Command, kept: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def fail(*_: object, **__: object) -> None:
        raise InvalidInput("OpenGL does not work on this machine")

    monkeypatch.setattr(making, "Photographer", fail)
    assert refused(command, "kept", *SMALL) == "OpenGL does not work on this machine"
