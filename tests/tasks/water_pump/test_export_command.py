"""`handeye export`: what it writes of a run and of a world, and what it refuses."""

import shutil
from pathlib import Path

import msgspec
import mujoco
import numpy as np
import pytest
from conftest import Command
from short_runs import begin

from handeye.runs.advance import advance
from handeye.runs.folder import CHECKPOINTS, open_new
from handeye.runs.runner import Runner

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def ended(tmp_path_factory: pytest.TempPathFactory) -> tuple[Path, Runner]:
    """The folder of a run that took a pin and let go of it, and the run as it ended; beside it, as it was half way."""
    path, start = tmp_path_factory.mktemp("runs") / "ended", begin()
    folder = open_new(path, start)
    runner = Runner(start, observers=lambda runner: [folder.watch(runner, start, again=False)])
    while runner.stage is None or runner.listing.stages[runner.stage] != "feel for nothing":
        advance(runner, steps=1)
    shutil.copytree(path, path.with_name("half-way"))
    advance(runner)
    runner.finish()
    folder.close()
    return path, runner


def end(folder: Path) -> tuple[mujoco.MjModel, mujoco.MjData]:
    """An export as plain MuJoCo has it, at its last keyframe."""
    model = mujoco.MjModel.from_xml_path(str(folder / "scene.xml"))
    data = mujoco.MjData(model)
    mujoco.mj_resetDataKeyframe(model, data, model.nkey - 1)
    mujoco.mj_forward(model, data)
    return model, data


def text(model: mujoco.MjModel, name: str) -> str:
    number = mujoco.mj_name2id(model, mujoco.mjtObj.mjOBJ_TEXT, name)
    first = model.text_adr[number]
    return bytes(model.text_data[first : first + model.text_size[number] - 1]).decode()


def test_a_finished_run_is_exported_as_it_ended(command: Command, ended: tuple[Path, Runner]) -> None:
    path, runner = ended
    code, out, err = command("export", "mjcf", str(path), "-o", "end")
    assert (code, err) == (0, "")
    assert out == f"end: short in the world of seed 0, after {runner.position} steps, at its end\n"
    model, data = end(Path("end"))
    assert text(model, "moment") == "final"
    assert data.time == runner.cell.truth.data.time
    for here, there in (
        ("pin1", "pin0"),
        ("pin2", "pin1"),
        ("base", "base"),
        ("stanford/link6", "stanford/link6"),
    ):
        assert np.abs(data.body(here).xpos - runner.cell.truth.data.body(there).xpos).max() < 1e-6


def test_a_run_that_is_not_finished_is_marked_so(command: Command, ended: tuple[Path, Runner]) -> None:
    path = ended[0].with_name("half-way")
    code, out, err = command("export", "mjcf", str(path), "-o", "half")
    assert (code, err) == (0, f"the run in {path} is not finished; its newest state is exported\n")
    assert out.endswith("at “feel for nothing”: unfinished\n")
    model, data = end(Path("half"))
    assert (text(model, "moment"), text(model, "shows")) == ("unfinished", out.strip().removeprefix("half: "))
    assert data.body("pin1").xpos[2] > 0.06  # drawn out of its holder
    assert "unfinished" in Path("half/README.md").read_text(encoding="utf-8")


def test_an_export_is_told_to_programs(command: Command, ended: tuple[Path, Runner]) -> None:
    code, out, err = command("export", "glb", str(ended[0]), "-o", "pump.glb", "--part", "pump", "--json")
    told = msgspec.json.decode(out)
    assert (code, err) == (0, "")
    assert (told["path"], told["format"], told["moment"], told["open"]) == ("pump.glb", "glb", "final", [])
    assert told["world"]["seed"] == 0
    assert {each["body"] for each in told["weights"]} == {
        "base", "gasket", "top", "rotor", *(f"screw{k}" for k in range(6))
    }  # fmt: skip


def test_an_export_takes_the_place_of_an_export_only_if_asked(
    command: Command, ended: tuple[Path, Runner]
) -> None:
    assert command("export", "mjcf", "--seed", "1", "-o", "a")[0] == 0
    drawn = Path("a/scene.xml").read_bytes()
    assert command("export", "mjcf", str(ended[0]), "-o", "a") == (
        2, "", "handeye: a already holds an export of handeye; --overwrite replaces it\n",
    )  # fmt: skip
    assert Path("a/scene.xml").read_bytes() == drawn
    assert command("export", "mjcf", str(ended[0]), "-o", "a", "--overwrite")[0] == 0
    assert Path("a/scene.xml").read_bytes() != drawn
    assert [place.name for place in Path.cwd().iterdir()] == ["a"]


def test_a_damaged_run_is_refused_in_one_sentence(command: Command, ended: tuple[Path, Runner]) -> None:
    shutil.copytree(ended[0], "run")
    for file in Path("run", CHECKPOINTS).iterdir():
        file.write_bytes(file.read_bytes()[:-1])
    code, out, err = command("export", "mjcf", "run", "-o", "a")
    assert (code, out, err.count("\n")) == (2, "", 1)
    assert "is damaged or cut short" in err
    assert not Path("a").exists()


def test_of_a_run_whose_end_is_damaged_the_state_before_is_exported_as_unfinished(
    command: Command, ended: tuple[Path, Runner]
) -> None:
    shutil.copytree(ended[0], "run")
    last = max(Path("run", CHECKPOINTS).glob("0*"))
    last.write_bytes(last.read_bytes()[:-1])
    code, _, err = command("export", "mjcf", "run", "-o", "a")
    left_out, unfinished = err.splitlines()
    assert (code, unfinished) == (0, "the run in run is not finished; its newest state is exported")
    assert left_out.startswith(f"left out: {last}")


def test_a_run_brings_its_own_world(command: Command, ended: tuple[Path, Runner]) -> None:
    code, _, err = command("export", "mjcf", str(ended[0]), "--seed", "3", "-o", "a")
    assert code == 2
    assert err.endswith(
        "has its own world; --seed, --level, --without, --set and --scale cannot be given with it\n"
    )


REFUSED = {
    "nothing": ("there is no such file", "nowhere"),
    "no run": ("holds no run", "."),
}


@pytest.mark.parametrize("what", REFUSED)
def test_what_is_no_run_is_refused(command: Command, what: str) -> None:
    sentence, run = REFUSED[what]
    code, out, err = command("export", "mjcf", run, "-o", "a")
    assert (code, out) == (2, "")
    assert sentence in err


def test_a_run_that_has_not_begun_is_refused(command: Command) -> None:
    open_new(Path("run"), begin())
    assert command("export", "mjcf", "run", "-o", "a") == (2, "", "handeye: the run in run has not begun\n")


def test_solids_are_written_and_what_is_wrong_with_them_is_said(
    command: Command, ended: tuple[Path, Runner]
) -> None:
    code, out, err = command("export", "glb", str(ended[0]), "-o", "pump.glb", "--part", "pump")
    assert (code, err) == (0, "")
    first, count, *weights = out.splitlines()
    assert first.startswith("pump.glb: pump, short in the world of seed 0, after")
    assert count == "16 solids, all closed"
    assert any("in the model: rotor" in line for line in weights)
    assert Path("pump.glb").read_bytes().startswith(b"glTF")


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("a.obj", "the name of the GLB file must end in .glb"),
        ("mine.glb", "exists and is not a GLB file; nothing was written"),
    ],
)
def test_solids_take_the_place_of_no_other_file(command: Command, name: str, sentence: str) -> None:
    Path("mine.glb").write_bytes(b"mine")
    code, out, err = command("export", "glb", "-o", name)
    assert (code, out) == (2, "")
    assert sentence in err
    assert Path("mine.glb").read_bytes() == b"mine"
