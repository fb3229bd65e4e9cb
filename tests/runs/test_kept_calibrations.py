"""Calibrations that are kept: found by all that decides them, whole or not at all, no more than there is room for."""

import os
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from typing import Any

import msgspec
import pytest
from short_runs import begin

from handeye.core.errors import InvalidInput
from handeye.core.packed import packed, sealed
from handeye.core.variation import Overrides, WorldSpec
from handeye.ports.camera import Renderer
from handeye.runs.runner import Runner
from handeye.systems.stanford.kept_calibrations import LARGEST, MAGIC, VERSION, KeptCalibrations
from handeye.systems.stanford.preparation import Conditions, Preparation, preparation_of

pytestmark = pytest.mark.slow  # for its file: a cell is built once

HERE = Conditions(
    task="water_pump",
    world=WorldSpec(seed=1),
    camera=Renderer(method="rays"),
    driver="",
    feels=True,
    versions={"handeye": "1"},
    code="0" * 16,
    machine=("Linux", "x86_64", "AVX2"),
)
ELSEWHERE: dict[str, Any] = {
    "task": "block",
    "world": WorldSpec(seed=1, overrides=Overrides(set={"part_mass": 0.01})),
    "camera": Renderer(method="opengl", platform="EGL"),
    "driver": "another",
    "feels": False,
    "versions": {"handeye": "2"},
    "code": "1" * 16,
    "machine": ("Linux", "x86_64"),
}


@pytest.fixture(scope="module")
def prepared() -> Preparation:
    runner = Runner(begin("OPEN 1"))
    return preparation_of(runner.context, runner.cell, 162.0, 3.3)


@pytest.fixture
def kept(tmp_path: Path, prepared: Preparation) -> KeptCalibrations:
    calibrations = KeptCalibrations(tmp_path / "new" / "folder")
    calibrations.keep(HERE, prepared)
    return calibrations


def test_what_is_kept_is_found_as_it_was(kept: KeptCalibrations, prepared: Preparation) -> None:
    found = kept.find(HERE)
    assert found is not None
    assert packed(found) == packed(prepared)


def test_every_condition_counts() -> None:
    assert {*ELSEWHERE} == {*Conditions.__struct_fields__}


@pytest.mark.parametrize("condition", ELSEWHERE)
def test_nothing_is_found_under_other_conditions(kept: KeptCalibrations, condition: str) -> None:
    assert kept.find(msgspec.structs.replace(HERE, **{condition: ELSEWHERE[condition]})) is None


def test_what_is_of_other_conditions_is_not_taken_by_its_name(
    kept: KeptCalibrations, prepared: Preparation
) -> None:
    other = msgspec.structs.replace(HERE, feels=False)
    (file,) = kept.files()
    kept.keep(other, prepared)
    data = next(path for path in kept.files() if path != file).read_bytes()
    file.write_bytes(data)
    assert kept.find(HERE) is None


def test_a_file_cut_short_anywhere_is_not_used(kept: KeptCalibrations) -> None:
    (file,) = kept.files()
    whole = file.read_bytes()
    for length in range(0, len(whole), 97):
        file.write_bytes(whole[:length])
        assert kept.find(HERE) is None


def test_a_file_with_a_flipped_bit_is_not_used(kept: KeptCalibrations) -> None:
    (file,) = kept.files()
    whole = file.read_bytes()
    for place in range(0, len(whole), 61):
        file.write_bytes(whole[:place] + bytes([whole[place] ^ 4]) + whole[place + 1 :])
        assert kept.find(HERE) is None


@pytest.mark.parametrize(
    "rest",
    [
        b"",
        packed(None),
        packed({"cell": 3}),
        packed(b"0" * (LARGEST + 1)),
        packed([[]] * 100_000),
        b"not compressed",
    ],
    ids=["nothing", "none", "another", "large", "deep", "plain"],
)
def test_a_sealed_file_with_nonsense_in_it_is_not_used(kept: KeptCalibrations, rest: bytes) -> None:
    (file,) = kept.files()
    file.write_bytes(sealed(MAGIC, VERSION, HERE.line + b"\n" + rest))
    assert kept.find(HERE) is None


def test_one_of_an_older_form_is_not_used_and_replaced(kept: KeptCalibrations, prepared: Preparation) -> None:
    (file,) = kept.files()
    new = file.read_bytes()
    file.write_bytes(sealed(MAGIC, VERSION - 1, new.partition(b"\n")[2]))
    assert kept.find(HERE) is None
    kept.keep(HERE, prepared)
    assert file.read_bytes() == new


@pytest.mark.skipif(not hasattr(os, "mkfifo"), reason="there are no pipes here")
def test_a_pipe_in_the_place_of_one_is_not_waited_for(kept: KeptCalibrations) -> None:
    (file,) = kept.files()
    file.unlink()
    os.mkfifo(file)
    assert kept.find(HERE) is None


def test_a_folder_that_cannot_be_made_is_told(tmp_path: Path, prepared: Preparation) -> None:
    (tmp_path / "file").write_text("in the way")
    kept = KeptCalibrations(tmp_path / "file" / "folder")
    assert kept.find(HERE) is None
    with pytest.raises(InvalidInput, match=r"cannot be created: Not a directory$"):
        kept.keep(HERE, prepared)


def test_without_a_folder_nothing_is_kept(prepared: Preparation) -> None:
    nowhere = KeptCalibrations(None)
    nowhere.keep(HERE, prepared)
    assert (nowhere.find(HERE), [*nowhere.entries()], nowhere.clear()) == (None, [], 0)


def test_the_oldest_go_when_there_are_too_many(kept: KeptCalibrations, prepared: Preparation) -> None:
    (first,) = kept.files()
    os.utime(first, (1e9, 1e9))
    crowded = KeptCalibrations(kept.folder, most=5 * first.stat().st_size // 2)
    for code in ("1", "2"):
        crowded.keep(msgspec.structs.replace(HERE, code=code), prepared)
    assert (first.exists(), len(crowded.files())) == (False, 2)


def test_clearing_removes_what_is_kept_and_nothing_else(kept: KeptCalibrations) -> None:
    assert kept.folder is not None
    (file,) = kept.files()
    (kept.folder / f".{file.name}.half").write_text("a process was killed")
    (kept.folder / "letter.txt").write_text("not ours")
    assert kept.clear() == 1
    assert [path.name for path in kept.folder.iterdir()] == ["letter.txt"]


def test_those_who_keep_the_same_at_once_do_not_harm_each_other(
    kept: KeptCalibrations, prepared: Preparation
) -> None:
    def keep_and_find(_: int) -> bool:
        kept.keep(HERE, prepared)
        return kept.find(HERE) is not None

    with ThreadPoolExecutor(4) as pool:
        assert all(pool.map(keep_and_find, range(24)))
    assert len(kept.files()) == 1


def test_entries_tell_which_world_they_are_of(kept: KeptCalibrations) -> None:
    assert kept.folder is not None
    (kept.folder / "0damaged.calibration").write_bytes(b"\n\n")
    (entry,) = kept.entries()
    assert (entry.task, entry.world, entry.camera) == (HERE.task, HERE.world, HERE.camera)
    assert entry.bytes == (kept.folder / entry.file).stat().st_size
