"""Runs as a data set: complete, with the failures, and made again only where something is missing."""

import json
import sys
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from conftest import Command

import handeye
from handeye.cell.opengl import context
from handeye.core.errors import BadFile, InvalidInput, MissingExtra, NoSuchName
from handeye.core.variation import WorldSpec
from handeye.datasets import lerobot, recording
from handeye.datasets.episodes import read_episode, runs_in
from handeye.datasets.recording import RecordedWorld, Recording, record_all, worlds

FOUND = RecordedWorld(name="opened", world=WorldSpec(seed=3))
STOPPED = RecordedWorld(name="stopped", world=WorldSpec(seed=4))


def recording_of(folder: Path, script: str) -> Recording:
    return Recording(folder=folder, plan=handeye.plan(script, task="insertion"), camera="ray")


@pytest.fixture(scope="module")
def folder(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A run that ends, and one that the program stops."""
    runs = tmp_path_factory.mktemp("data") / "runs"
    assert recording_of(runs, "OPEN 1\n")(FOUND) == "false done"  # there is no pin in the hole
    assert recording_of(runs, "CLOSE .5\n")(STOPPED) == "stopped"
    return runs


class Library:
    """Takes what LeRobot's data set class takes, and checks each frame against the features."""

    made: "Library"

    @classmethod
    def create(cls, *, features: dict[str, dict[str, Any]], root: Path, **settings: object) -> "Library":
        cls.made = made = cls()
        made.features, made.settings, made.saved, made.num_frames, made.last = features, settings, 0, 0, {}
        (root / "meta").mkdir(parents=True)
        (root / "images/observation.images.television/episode-000000").mkdir(
            parents=True
        )  # LeRobot leaves it empty
        return made

    def add_frame(self, frame: dict[str, Any]) -> None:
        assert frame.keys() - {"task"} == self.features.keys()
        for name, feature in self.features.items():
            if feature["dtype"] == "string":
                assert isinstance(frame[name], str)
            else:
                dtype = "uint8" if feature["dtype"] == "video" else feature["dtype"]
                assert (frame[name].shape, str(frame[name].dtype)) == (feature["shape"], dtype)
        self.num_frames, self.last = self.num_frames + 1, frame

    def save_episode(self) -> None:
        assert self.last["next.done"]
        self.saved += 1

    def finalize(self) -> None:
        """Nothing is left to write."""


@pytest.fixture
def library(monkeypatch: pytest.MonkeyPatch) -> type[Library]:
    monkeypatch.setattr(lerobot, "_library", lambda: Library)
    return Library


@pytest.mark.slow
def test_every_frame_has_the_features_that_the_library_was_promised(
    folder: Path, tmp_path: Path, library: type[Library]
) -> None:
    written = lerobot.write_dataset(tmp_path / "data", [folder])
    made = library.made
    assert (made.saved, made.settings["fps"], made.num_frames) == (2, 10, written.frames)
    assert "observation.images.television" not in made.features  # this cell has no camera
    assert made.last["task"] == "The pin is in its hole."
    assert not (tmp_path / "data/images").exists()


@pytest.mark.slow
def test_failures_are_in_the_data_and_marked(folder: Path, tmp_path: Path, library: type[Library]) -> None:
    written = lerobot.write_dataset(tmp_path / "data", [folder])
    assert written.outcomes == {"false done": 1, "stopped": 1}
    assert (library.made.last["annotation.outcome"], bool(library.made.last["next.success"])) == (
        "stopped",
        False,
    )
    lines = (tmp_path / "data" / lerobot.EPISODES).read_text().splitlines()
    assert [json.loads(line)["outcome"] for line in lines] == ["false done", "stopped"]
    card = (tmp_path / "data" / lerobot.CARD).read_text()
    assert "privileged" not in card + " ".join(library.made.features)
    assert (
        "| `stopped` | 1 | the program noticed a fault and called the operator, or was interrupted |" in card
    )


@pytest.mark.slow
def test_a_rendered_view_is_in_the_data_only_on_request_and_marked_as_no_sensor(
    folder: Path, tmp_path: Path, library: type[Library]
) -> None:
    try:
        context()
    except InvalidInput as reason:
        pytest.skip(str(reason))
    lerobot.write_dataset(tmp_path / "data", [folder], view="studio")
    images = {name for name, feature in library.made.features.items() if feature["dtype"] == "video"}
    assert images == {"privileged.images.view"}
    assert library.made.last["privileged.images.view"].std() > 30  # the cell is in it
    card = (tmp_path / "data" / lerobot.CARD).read_text()
    assert "`privileged.images.view` | view of the camera `studio`" in card
    assert "**The robot has no such sensor.**" in card
    with pytest.raises(NoSuchName, match=r"^there is no camera hand; the cameras are studio$"):
        lerobot.write_dataset(tmp_path / "other", [folder], view="hand")
    assert [each.name for each in tmp_path.iterdir()] == ["data"]


@pytest.mark.slow
def test_a_data_set_that_fails_half_way_leaves_nothing(
    folder: Path, tmp_path: Path, library: type[Library], monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delattr(library, "finalize")
    with pytest.raises(AttributeError):
        lerobot.write_dataset(tmp_path / "data", [folder])
    assert [*tmp_path.iterdir()] == []


def test_a_picture_of_sixteen_levels_becomes_an_image_with_an_even_number_of_columns() -> None:
    picture = np.full((256, 333), 15, dtype=np.uint8)
    image = lerobot.shown(picture)
    assert (image.shape, image[0, 332].tolist(), image[0, 333].tolist()) == (
        (256, 334, 3),
        [255] * 3,
        [0] * 3,
    )


@pytest.mark.slow
def test_a_run_that_has_ended_is_not_recorded_again(folder: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def begin(*_: object, **__: object) -> None:
        raise AssertionError("a run begins")

    monkeypatch.setattr(recording, "begin", begin)
    assert record_all(recording_of(folder, "OPEN 1\n"), (FOUND, STOPPED), jobs=1) == {
        "false done": 1,
        "stopped": 1,
    }


@pytest.mark.slow
def test_a_run_that_was_interrupted_continues_where_it_was(tmp_path: Path) -> None:
    plan = handeye.plan("OPEN 1\nOPEN 2\n", task="insertion")
    with handeye.begin(plan, seed=3, camera="ray", judge=True, out=tmp_path / "opened") as run:
        run.step()
    (tmp_path / "opened" / "result.json").unlink()
    before = run.events
    assert Recording(folder=tmp_path, plan=plan, camera="ray")(FOUND) == "false done"
    assert handeye.open(tmp_path / "opened").events[: len(before) - 1] == before[:-1]


def test_faults_of_the_standard_set_follow_the_worlds_without_faults() -> None:
    plan = handeye.plan(handeye.scripts / "water_pump.al")
    found = worlds(plan, WorldSpec(seed=7), n=2, faulty=2)
    assert [each.name for each in found] == [
        "seed-7",
        "seed-8",
        "seed-9-finger_switch.stuck_closed",
        "seed-10-finger_switch.minus_y.stuck_open",
    ]
    assert [each.world.seed for each in found] == [7, 8, 9, 10]


@pytest.mark.parametrize(
    ("options", "meant"),
    [
        ((), {"pictures": True, "view": None}),
        (("--no-pictures", "--view", "studio"), {"pictures": False, "view": "studio"}),
    ],
)
def test_the_command_chooses_the_images(
    command: Command, monkeypatch: pytest.MonkeyPatch, options: tuple[str, ...], meant: dict[str, object]
) -> None:
    given: dict[str, object] = {}

    def write_dataset(path: Path, places: list[Path], **settings: object) -> lerobot.WrittenDataset:
        given.update(settings)
        return lerobot.WrittenDataset(path=str(path), episodes=1, frames=2, outcomes={"right": 1})

    monkeypatch.setattr(lerobot, "write_dataset", write_dataset)
    assert command("export", "lerobot", "runs", "-o", "data", *options) == (
        0,
        "data: 1 episode, 2 frames; 1 right\n",
        "",
    )
    assert given.items() >= meant.items()


def test_a_place_without_runs_is_refused(tmp_path: Path) -> None:
    with pytest.raises(BadFile, match=r"holds no run with a trace\.mcap$"):
        runs_in([tmp_path])
    with pytest.raises(BadFile, match=r"there is no such folder$"):
        runs_in([tmp_path / "nowhere"])


def test_a_run_that_has_not_ended_is_no_episode(tmp_path: Path) -> None:
    (tmp_path / "run").mkdir()
    with pytest.raises(BadFile, match=r"has not ended; `handeye resume .*run` continues it$"):
        read_episode(tmp_path / "run", 0)


def test_without_the_library_the_command_names_the_extra(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setitem(sys.modules, "lerobot", None)
    with pytest.raises(MissingExtra, match=r"`export lerobot` needs 'lerobot\[dataset\]', which is not"):
        lerobot._library()
