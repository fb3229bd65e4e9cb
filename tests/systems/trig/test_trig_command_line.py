"""`handeye trig`: programs run, shown and typed from the command line."""

import json
import os
import signal
from itertools import count
from pathlib import Path
from typing import Any

import cv2
import numpy as np
import pytest
from conftest import Command
from trig_bench import low_script
from trig_sessions import PLANS

from handeye.cli.panic_button import PanicButton
from handeye.systems.trig.jobs import referee
from handeye.systems.trig.language.axes_arm import AxesArm
from handeye.systems.trig.language.trig_arm import Resistance
from handeye.systems.trig.run import job as taught_job
from handeye.systems.trig.run import job_page, job_video
from handeye.systems.trig.run.pallet_trials import broken_off_after

PALLETISE = str(PLANS / "palletise.trig")


def test_a_script_is_typed_run_and_run_back(command: Command) -> None:
    assert command("trig", "run", PALLETISE, "--back") == (
        0,
        "227 steps done; the program has ended\n227 steps undone; no earlier steps can be undone\n",
        "",
    )


def test_a_run_is_told_as_json(command: Command) -> None:
    code, out, err = command("trig", "run", PALLETISE, "--json")
    told = json.loads(out)
    assert (code, told["forward"], told["back"]) == (0, {"steps": 227, "end": "none", "obstacle": None}, None)
    assert (told["cursor"], told["arm"][:3], len(told["blocks"])) == ("FINISH", [0, 150, 200], 20)
    assert err == "227 steps done; the program has ended\n"


def test_both_displays_of_a_program_are_shown(command: Command) -> None:
    code, out, _ = command("trig", "show", PALLETISE, "--width", "80")
    assert (code, out.count("GET-BLOCK"), "─@─^" in out or "[@]^" in out) == (0, 3, True)
    assert command("trig", "show", PALLETISE, "--width", "5")[0] == 2


def test_the_name_of_a_script_may_have_brackets(command: Command) -> None:
    Path("tg[").mkdir()
    Path("tg[/]x.trig").write_text("M A\nX 10 RECORD\n", encoding="utf-8")
    assert command("trig", "show", "tg[/]x.trig")[::2] == (0, "")


def test_a_program_that_was_written_is_run(command: Command) -> None:
    typed = "M A\nX 20 RECORD\nM B\nX 40 RECORD\nEX both\n"
    assert command("trig", typed=typed) == (0, "written to both.trig.json\n", "")
    code, out, _ = command("trig", "run", "both.trig.json", "--back")
    assert (code, out.splitlines()[0]) == (0, "2 steps done; the program has ended")


def test_what_is_piped_in_is_heard_and_what_is_refused_is_told(command: Command) -> None:
    code, out, _ = command("trig", typed="M A\nX 20 RECORD\nGRAPS\nGRASP\nW it\n")
    assert (code, out) == (
        2,
        "line 3: there is no command `GRAPS`; did you mean GRASP?\nwritten to it.trig.json\n",
    )
    assert len(json.loads(Path("it.trig.json").read_bytes())["nodes"]) == 3


def test_a_script_that_is_wrong_is_told_by_its_line(command: Command) -> None:
    Path("bad.trig").write_text("; a remark\n>M A\n  X 10 RECORD\n>LOOP B 2\n", encoding="utf-8")
    assert command("trig", "run", "bad.trig") == (
        2,
        "",
        "handeye: bad.trig, line 4: there is no step `B`; CN names the active step\n",
    )
    assert command("trig", "run", "none.trig")[0] == 2


def test_a_run_that_the_arm_cannot_do_is_stopped(command: Command) -> None:
    Path("far.trig").write_text("MR A\nX BY 90 RECORD\nCN A\nLOOP A 5\n", encoding="utf-8")
    code, _, err = command("trig", "run", "far.trig")
    assert (code, err) == (1, "handeye: X would be 270 mm; its range is -200 to 200 mm\n")


@pytest.mark.parametrize("words", [("trig", "--arm", "puma"), ("trig", "run"), ("trig", "show", "a", "b")])
def test_wrong_words_are_told(command: Command, words: tuple[str, ...]) -> None:
    code, _, err = command(*words)
    assert (code, err.startswith("handeye: ")) == (2, True)


@pytest.fixture
def low(monkeypatch: pytest.MonkeyPatch) -> None:
    """The palletiser lifts its hand no higher than it must for few blocks, which takes a third of the time."""
    monkeypatch.setattr(taught_job, "job_script", lambda _, blocks: low_script(blocks))


@pytest.mark.slow
@pytest.mark.usefixtures("low")
def test_a_job_that_is_right_is_told_and_kept(command: Command) -> None:
    code, out, err = command("trig", "palletise", "--blocks", "1", "--seed", "3", "--json", "--out", "job")
    told = json.loads(out)
    assert (code, told["outcome"], told["seed"], told["blocks"]) == (0, "right", 3, 1)
    assert told["forward"]["steps"] == told["back"]["steps"] == 19
    assert told["checks"]["placed"]["ok"]
    assert err.startswith("teaching palletise in the world of seed 3\n19 steps done; the program has ended\n")
    assert json.loads(Path("job/job.json").read_bytes()) == told
    assert json.loads(Path("job/result.json").read_bytes())["apart"] is True
    assert command("trig", "show", "job/program.trig.json")[0] == 0
    assert "Palletise: right" in Path("job/report.html").read_text(encoding="utf-8")
    assert command("trig", "palletise", "--out", "job")[0] == 2  # it is not overwritten by chance
    assert command("trace", "verify", "job/trace.mcap")[0] == 0
    assert command("resume", "job")[0] == 0  # there is nothing left to do
    command("resume", "job", "--step", typed="quit\n")
    assert json.loads(Path("job/job.json").read_bytes()) == told  # nor has anything been done
    assert "Palletise: right" in Path("job/report.html").read_text(encoding="utf-8")
    assert command("report", "job", "-o", "other.html")[0] == 0
    assert Path("other.html").read_bytes() == Path("job/report.html").read_bytes()
    assert command("report", "job")[1] == "job/report.html; the earlier file is replaced\n"


@pytest.mark.slow
@pytest.mark.usefixtures("low")
def test_kept_jobs_are_compared_in_their_units_and_filmed(command: Command) -> None:
    for seed in ("3", "4"):
        words = ("--blocks", "0", "--seed", seed, "--without", "stack.place", "--out", seed)
        assert command("trig", "palletise", *words)[0] == 0
    page = Path("3/report.html").read_text(encoding="utf-8")
    assert "in the world of seed 3, without stack.place, with 0 blocks" in page
    code, out, _ = command("compare", "3", "4")
    assert (code, "in B" in out) == (0, True)
    assert "place x of body cross_slide: A 120.487 mm, B 119.987 mm" in out
    assert "Both runs took the same course" in out
    assert "Both runs are identical, to the last bit." in command("compare", "3", "3")[1]
    assert command("video", "3", "--seconds", "1", "--size", "32x24", "--captions")[0] == 0
    assert Path("3/video.webp").exists()


@pytest.mark.slow
@pytest.mark.usefixtures("low")
@pytest.mark.parametrize("limit", ["PLACED", "BACK"])
def test_a_job_that_is_done_and_wrong_has_an_exit_code_of_its_own(
    command: Command, monkeypatch: pytest.MonkeyPatch, limit: str
) -> None:
    monkeypatch.setattr(referee, limit, 0.0)
    code, out, _ = command("trig", "palletise", "--blocks", "1", "--out", "job")
    page = Path("job/report.html").read_text(encoding="utf-8")
    assert "Palletise: done, but the referee disagrees" in page
    assert page.count("✗") == 1
    assert (code, out.splitlines()[-1]) == (3, "Done, but the referee disagrees.")
    assert out.count("WRONG") == 1
    result = json.loads(Path("job/result.json").read_bytes())
    assert (result["assembled"], result["apart"]) == (limit != "PLACED", limit != "BACK")
    assert command("resume", "job")[0] == 3


@pytest.mark.slow
@pytest.mark.usefixtures("low")
def test_a_batch_counts_a_job_that_is_done_and_wrong_as_silent(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(referee, "BACK", 0.0)
    code, out, _ = command("trials", "pallet", "--n", "1", "--seed", "5", "--blocks", "1", "--json")
    told = json.loads(out)
    assert (code, told["silent_failures"]) == (3, 1)
    assert told["failures"][0]["command"] == "handeye trials pallet --n 1 --seed 5 --blocks 1"


@pytest.mark.slow
@pytest.mark.usefixtures("low")
def test_a_job_whose_arm_is_stopped_says_what_it_has_met(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(AxesArm, "back", lambda *_: Resistance(force=4.0, limit=3.0))
    code, out, _ = command("trig", "palletise", "--blocks", "0", "--out", "job")
    assert (code, out.splitlines()[-2:]) == (
        1,
        [
            "0 steps undone; the arm stopped while undoing the next earlier step: "
            "the finger met a force of 4.0 N; the limit while going back is 3.0 N",
            "The arm has stopped.",
        ],
    )
    assert json.loads(Path("job/job.json").read_bytes())["back"]["obstacle"]["force"] == 4.0


def test_a_job_that_somebody_stops_is_interrupted(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(PanicButton, "__call__", lambda _: True)
    assert command("trig", "palletise", "--blocks", "1", "--video", "job.webp", "--out", "job")[0] == 130
    assert not Path("job").exists()  # nothing had begun


@pytest.mark.slow
@pytest.mark.usefixtures("low")
def test_a_job_that_is_interrupted_on_its_way_is_resumed_and_dismantled(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    asked = count()
    monkeypatch.setattr(PanicButton, "__call__", lambda _: next(asked) < 0)
    assert command("trig", "palletise", "--blocks", "1", "--out", "whole")[0] == 0
    for folder, far in (("on", 2300), ("back", next(asked) - 500)):
        again = count()
        monkeypatch.setattr(PanicButton, "__call__", lambda _, again=again, far=far: next(again) > far)
        code, _, err = command("trig", "palletise", "--blocks", "1", "--out", folder)
        assert (code, f"resume with: handeye resume {folder}" in err) == (130, True)
        assert command("show", folder)[2] == f"resume with: handeye resume {folder}\n"
        monkeypatch.setattr(PanicButton, "__call__", lambda _: False)
        assert command("dismantle", folder, "--out", f"{folder}_apart")[0] == 0
        assert json.loads(Path(f"{folder}_apart/result.json").read_bytes())["apart"] is True
        assert not Path(f"{folder}_apart/job.json").exists()
        assert command("resume", folder)[0] == 0
        for name in ("job.json", "program.trig.json", "report.html", "trace.mcap"):
            assert Path(folder, name).read_bytes() == Path("whole", name).read_bytes()
        assert _without_host_time(folder) == _without_host_time("whole")


def _without_host_time(folder: str) -> dict[str, Any]:
    result: dict[str, Any] = json.loads(Path(folder, "result.json").read_bytes())
    for name in ("run_cpu_s", "run_wall_s", "real_time_factor"):
        del result["timing"][name]
    return result


@pytest.mark.slow
@pytest.mark.usefixtures("low")
def test_a_key_behind_the_last_step_loses_nothing_of_what_a_job_came_to(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    write = job_page.job_files

    def struck(*words: Any) -> dict[str, bytes]:
        assert not Path("job/result.json").exists()  # which says that all is there
        os.kill(os.getpid(), signal.SIGINT)
        return write(*words)

    monkeypatch.setattr(job_page, "job_files", struck)
    assert command("trig", "palletise", "--blocks", "0", "--out", "job")[0] == 0
    assert json.loads(Path("job/job.json").read_bytes())["outcome"] == "right"


@pytest.mark.slow
@pytest.mark.usefixtures("low")
def test_palletisers_are_tried_in_many_worlds_to_their_end_or_broken_off(command: Command) -> None:
    code, out, _ = command("trials", "pallet", "--n", "2", "--blocks", "1", "--interrupt", "--jobs", "1")
    assert (code, "2 of 2 right, 0 silent failures" in out) == (0, True)
    assert len({broken_off_after(seed, 6) for seed in range(20)}) > 10


@pytest.mark.parametrize(
    "words",
    [
        ("trig", "palletise", "--blocks", "21"),
        ("trig", "palletise", "--blocks", "-1"),
        ("trig", "bucket", "--seed", "-1"),
        ("trials", "pallet", "--n", "0"),
        ("trials", "pallet", "--blocks", "21"),
    ],
)
def test_jobs_that_cannot_be_are_refused(command: Command, words: tuple[str, ...]) -> None:
    code, out, err = command(*words)
    assert (code, out, err.count("\n")) == (2, "", 1)


@pytest.mark.slow
@pytest.mark.render
def test_a_job_leaves_a_video_and_replaces_none_by_chance(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(job_video, "WIDTH", 32)
    monkeypatch.setattr(job_video, "HEIGHT", 24)
    assert command("trig", "bucket", "--video", "job.webp")[0] == 0
    animation = cv2.imdecodeanimation(np.fromfile("job.webp", np.uint8))[1]
    assert len(animation.frames) > 20
    assert np.ptp([frame.mean() for frame in animation.frames]) > 1  # something moves
    assert command("trig", "bucket", "--video", "job.webp")[0] == 2
    assert command("trig", "bucket", "--video", "job.gif")[0] == 2
    code, _, err = command("trig", "bucket", "--out", "job", "--video", "job/it.webp")
    assert (code, "is in the folder of --out" in err) == (2, True)


@pytest.mark.slow
def test_the_bucket_job_is_carried_out_in_a_drawn_world(command: Command) -> None:
    code, out, _ = command("trig", "bucket", "--seed", "4")
    assert (code, out.splitlines()[-1], out.count("  right  ")) == (0, "Right.", 5)
