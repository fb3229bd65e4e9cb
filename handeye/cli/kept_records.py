"""Records of trials, kept in a file as they end."""

from operator import attrgetter
from pathlib import Path
from typing import Any

from handeye.core.files import Kind, check_free, check_place, write_over


class KeptRecords(list[Any]):
    """Records, of which those that there are so far stand in a file, in order of a field: nothing that ends is lost."""

    def __init__(self, out: Path | None, kind: Kind, *, by: str, overwrite: bool) -> None:
        """None yet. `out`: the file; None: they are not written.

        Raises:
            InvalidInput: that file cannot be written, or it is there and may not be replaced.
        """
        super().__init__()
        if out is not None:
            check_place(out, kind)
            check_free(out, kind.name, overwrite=overwrite)
        self._out, self._kind, self._order = out, kind, attrgetter(by)

    def keep(self, record: Any) -> None:
        """Add a record, and write all of them.

        Raises:
            InvalidInput: the file cannot be written.
        """
        import msgspec

        self.append(record)
        if self._out is not None:
            lines = [msgspec.json.encode(each) + b"\n" for each in sorted(self, key=self._order)]
            write_over(self._out, b"".join(lines), self._kind)
