"""Files are written whole or not at all."""

import os
from pathlib import Path

import pytest

from handeye.errors import InvalidInput
from handeye.files import write_whole


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
