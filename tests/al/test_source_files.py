"""A file becomes a text, or one clear sentence says why not."""

from pathlib import Path

import pytest

from handeye.core.errors import InvalidInput
from handeye.core.source import Source, read_source


def test_text_is_read_without_its_byte_order_mark(tmp_path: Path) -> None:
    path = tmp_path / "a.al"
    path.write_bytes(b"\xef\xbb\xbfPARK\r\n")
    assert read_source(path) == Source(name=str(path), text="PARK\r\n")


def test_lines_that_end_with_a_carriage_return_alone_are_lines(tmp_path: Path) -> None:
    path = tmp_path / "a.al"
    path.write_bytes(b"OPEN 1\rOPEN 2\r")
    assert read_source(path).text == "OPEN 1\nOPEN 2\n"


@pytest.mark.parametrize("mark", [b"", b"\xef\xbb\xbf"])
def test_byte_that_is_not_utf8_is_named_with_its_offset(tmp_path: Path, mark: bytes) -> None:
    path = tmp_path / "a.al"
    path.write_bytes(mark + b"PARK\n\xff\n")
    with pytest.raises(InvalidInput, match=rf"a\.al is not UTF-8 text: byte {5 + len(mark)} is 0xff$"):
        read_source(path)


def test_missing_file_is_named(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r"none\.al: there is no such file$"):
        read_source(tmp_path / "none.al")


def test_directory_is_no_text(tmp_path: Path) -> None:
    with pytest.raises(InvalidInput, match=r" is a directory, not a file$"):
        read_source(tmp_path)


def test_device_is_no_text() -> None:
    with pytest.raises(InvalidInput, match=r"^/dev/null is a device or a pipe, not a file$"):
        read_source("/dev/null")


def test_impossible_names_are_refused_in_words() -> None:
    with pytest.raises(InvalidInput, match=r"cannot be read: |no such file$"):
        read_source("a\0b")
    with pytest.raises(InvalidInput, match=r"cannot be read: .*too long"):
        read_source("x" * 5000)
