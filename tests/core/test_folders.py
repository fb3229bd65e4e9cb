"""A folder is written whole or not at all, and takes the place of nobody else's."""

import errno
import os
from pathlib import Path

import pytest

from handeye.core.errors import InvalidInput
from handeye.core.folders import FolderKind, check_folder, write_folder

LISTS = FolderKind(name="a folder of lists", known_by="list", begins=b"# list", holds=("list", "parts/*.txt"))
FILES = {"list": b"# list of two", "parts/one.txt": b"1", "parts/two.txt": b"2"}


def content(path: Path) -> dict[str, bytes]:
    return {str(file.relative_to(path)): file.read_bytes() for file in path.rglob("*") if file.is_file()}


def test_a_folder_takes_the_place_of_the_one_before_with_all_its_files(tmp_path: Path) -> None:
    write_folder(tmp_path / "a", {**FILES, "parts/three.txt": b"3"})
    write_folder(tmp_path / "a", FILES)
    assert content(tmp_path) == {f"a/{name}": data for name, data in FILES.items()}


@pytest.mark.parametrize("fails", ["os.fsync", "pathlib.Path.rename"])
def test_a_full_disk_leaves_the_folder_before_and_nothing_beside_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, fails: str
) -> None:
    write_folder(tmp_path / "a", FILES)
    before, did = content(tmp_path), Path.rename

    def full(*what: object) -> object:
        if fails == "os.fsync" or (what[1:] == (tmp_path / "a",) and Path(str(what[0])).name == "new"):
            raise OSError(errno.ENOSPC, "No space left on device")
        return did(*what)  # type: ignore[arg-type]

    monkeypatch.setattr(fails, full)
    with pytest.raises(InvalidInput, match=r"a cannot be written: No space left on device$"):
        write_folder(tmp_path / "a", {"list": b"# list of none"})
    assert content(tmp_path) == before


def test_ctrl_c_leaves_nothing(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    def interrupted(_: int) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("os.fsync", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_folder(tmp_path / "a", FILES)
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("name", ["mine", "parts/mine", "parts/deep/one.txt", "list.txt"])
def test_a_folder_with_anything_else_in_it_is_refused(tmp_path: Path, name: str) -> None:
    write_folder(tmp_path / "a", {**FILES, name: b""})
    sentence = rf"^{tmp_path / 'a'} holds other files \(`{name}`\); choose a new folder, or an empty one$"
    with pytest.raises(InvalidInput, match=sentence):
        check_folder(tmp_path / "a", LISTS, overwrite=True)


def test_files_of_the_right_names_alone_do_not_make_a_folder_ours(tmp_path: Path) -> None:
    write_folder(tmp_path / "a", {**FILES, "list": b"shopping"})
    with pytest.raises(InvalidInput, match="holds other files"):
        check_folder(tmp_path / "a", LISTS, overwrite=True)


def test_one_of_its_kind_is_replaced_only_if_asked(tmp_path: Path) -> None:
    write_folder(tmp_path / "a", FILES)
    check_folder(tmp_path / "a", LISTS, overwrite=True)
    with pytest.raises(InvalidInput, match=r"a already holds a folder of lists; --overwrite replaces it$"):
        check_folder(tmp_path / "a", LISTS, overwrite=False)


def test_an_empty_folder_may_be_written(tmp_path: Path) -> None:
    (tmp_path / "a").mkdir()
    check_folder(tmp_path / "a", LISTS, overwrite=False)
    write_folder(tmp_path / "a", FILES)
    assert content(tmp_path / "a") == FILES


def test_a_file_and_a_folder_in_no_folder_are_refused(tmp_path: Path) -> None:
    (tmp_path / "a").touch()
    with pytest.raises(InvalidInput, match=r"a is not a folder$"):
        check_folder(tmp_path / "a", LISTS, overwrite=True)
    with pytest.raises(InvalidInput, match=r"c cannot be written: No such file or directory$"):
        check_folder(tmp_path / "b" / "c", LISTS, overwrite=False)


def test_the_folder_that_one_is_in_is_not_replaced(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    with pytest.raises(InvalidInput, match=r"^\. is the current folder"):
        check_folder(Path(os.curdir), LISTS, overwrite=False)
