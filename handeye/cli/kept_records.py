"""Records of trials, kept in a file as they end."""

from collections.abc import Iterator
from contextlib import contextmanager
from operator import attrgetter
from pathlib import Path
from typing import Any

from handeye.files import Kind, check_place, write_over


@contextmanager
def kept(out: Path | None, kind: Kind, *, by: str) -> Iterator[list[Any]]:
    """A list of records that are written to a file in the end, in order of a field; also where trials are broken off.

    Raises:
        InvalidInput: that file cannot be written.
    """
    import msgspec

    if out is not None:
        check_place(out, kind)
    records: list[Any] = []
    try:
        yield records
    finally:
        if out is not None and records:
            lines = [msgspec.json.encode(each) + b"\n" for each in sorted(records, key=attrgetter(by))]
            write_over(out, b"".join(lines), kind)
