"""Files are written whole or not at all."""

import errno
import fcntl
import os
from pathlib import Path

import pytest

from handeye.core.errors import InvalidInput
from handeye.core.files import (
    Kind,
    LineFile,
    is_there,
    page_kind,
    read_whole,
    settle,
    write_over,
    write_whole,
)


def test_ctrl_c_in_the_middle_of_writing_leaves_the_file_before_and_nothing_beside_it(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    path = tmp_path / "a"
    write_whole(path, b"before")

    def interrupted(_: int) -> None:
        raise KeyboardInterrupt

    monkeypatch.setattr("os.fsync", interrupted)
    with pytest.raises(KeyboardInterrupt):
        write_whole(path, b"after")
    assert [file.name for file in tmp_path.iterdir()] == ["a"]
    assert path.read_bytes() == b"before"


def test_what_a_link_leads_to_is_written_and_stays_readable_for_whom_it_was(tmp_path: Path) -> None:
    file, link = tmp_path / "a", tmp_path / "b"
    file.touch(mode=0o600)
    link.symlink_to(file)
    write_whole(link, b"after")
    assert link.is_symlink()
    assert (file.read_bytes(), file.stat().st_mode & 0o777) == (b"after", 0o600)


def test_a_pipe_or_device_is_not_replaced_by_a_file(tmp_path: Path) -> None:
    pipe = tmp_path / "pipe"
    os.mkfifo(pipe)
    with pytest.raises(InvalidInput, match=r"pipe cannot be written: it is not a file$"):
        write_whole(pipe, b"after")
    assert pipe.is_fifo()


def test_a_file_that_is_written_anew_can_be_read_by_whom_the_user_lets_read(tmp_path: Path) -> None:
    before = os.umask(0o027)
    try:
        write_whole(tmp_path / "a", b"new")
    finally:
        os.umask(before)
    assert (tmp_path / "a").stat().st_mode & 0o777 == 0o640


def test_a_file_that_is_too_large_is_not_read(tmp_path: Path) -> None:
    (tmp_path / "a").write_bytes(b"12345")
    assert read_whole(tmp_path / "a", largest=5) == b"12345"
    with pytest.raises(InvalidInput, match=r"a has 5 bytes; the limit is 4$"):
        read_whole(tmp_path / "a", largest=4)


def test_a_file_of_another_kind_is_not_written_over(tmp_path: Path) -> None:
    path, kind = tmp_path / "a", Kind("list", rb"# list")
    path.write_bytes(b"# something else")
    with pytest.raises(InvalidInput, match=r"a exists and is not a list; nothing was written$"):
        write_over(path, b"# list of mine", kind)
    assert path.read_bytes() == b"# something else"


def test_a_page_of_an_earlier_version_is_written_over(tmp_path: Path) -> None:
    path, kind = tmp_path / "a.html", page_kind("list", "<!DOCTYPE html>\n<!-- list -->\n")
    path.write_bytes(b"<!doctype html>\n<!-- list -->\n<p>")
    write_over(path, b"<!DOCTYPE html>\n<!-- list -->\n<i>", kind)
    with pytest.raises(InvalidInput):
        write_over(
            path, b"<!DOCTYPE html>\n<!-- map -->\n", page_kind("map", "<!DOCTYPE html>\n<!-- map -->\n")
        )


LONGEST = "n" * 255


def test_the_longest_name_that_a_file_can_have_can_be_written(tmp_path: Path) -> None:
    write_whole(tmp_path / LONGEST, b"before")
    write_whole(tmp_path / LONGEST, b"after")
    assert {file.name: file.read_bytes() for file in tmp_path.iterdir()} == {LONGEST: b"after"}


@pytest.mark.parametrize("name", [f"{LONGEST}n", "none", "none/none", "\0"])
def test_what_cannot_be_there_is_not_there(tmp_path: Path, name: str) -> None:
    assert not is_there(tmp_path / name)


@pytest.mark.parametrize("to", ["link", "none"])
def test_a_link_that_leads_nowhere_is_there_and_told_as_such(tmp_path: Path, to: str) -> None:
    link = tmp_path / "link"
    link.symlink_to(to)
    assert is_there(link)
    with pytest.raises(InvalidInput, match=r"link is a broken link$"):
        read_whole(link)


@pytest.mark.parametrize("number", [errno.ENOLCK, errno.ENOTSUP, errno.ENOSYS, errno.EINVAL])
def test_where_there_are_no_locks_a_file_is_written_unguarded(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, number: int
) -> None:
    def lock(*_: object) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr(fcntl, "flock", lock)
    file = LineFile(tmp_path / "a", "another run")
    file.append(b"line\n")
    file.close()
    assert (file.unlocked, file.path.read_bytes()) == (os.strerror(number), b"line\n")


@pytest.mark.parametrize(
    ("number", "serious"), [(errno.EINVAL, False), (errno.ENOSYS, False), (errno.EIO, True)]
)
def test_a_file_system_that_cannot_say_when_all_is_on_the_disk_is_no_full_disk(
    monkeypatch: pytest.MonkeyPatch, number: int, serious: bool
) -> None:
    def fail(_: int) -> None:
        raise OSError(number, os.strerror(number))

    monkeypatch.setattr("os.fsync", fail)
    if not serious:
        settle(0)
        return
    with pytest.raises(OSError, match=os.strerror(number)):
        settle(0)


def test_a_file_system_without_modes_keeps_files_all_the_same(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    def refuse(*_: object) -> None:
        raise PermissionError(errno.EPERM, "Operation not permitted")

    monkeypatch.setattr("os.chmod", refuse)
    write_whole(tmp_path / "a", b"new")
    assert (tmp_path / "a").read_bytes() == b"new"
