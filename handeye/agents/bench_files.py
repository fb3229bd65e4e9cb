"""The files of a task of the agents' bench. A file is in the folder of the task, or is made from another file by
replacing pieces of that file's text.
"""

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import msgspec

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadFile
from handeye.core.files import read_whole
from handeye.core.resources import plans
from handeye.core.source import read_source

GIVEN, REFERENCE, TRIVIAL = "given", "reference", "trivial"  # folders of a task
FOLDERS: Final = (GIVEN, REFERENCE, TRIVIAL)
_PLANS: Final = "plans"


class Derived(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """A file that is derived from another."""

    source: str = msgspec.field(name="from")
    """Name of the file from which this file is derived: `FOLDER/NAME` for another file of the task, `TASK/FOLDER/NAME`
    for a file of another task, or `plans/NAME` for a program included with handeye.
    """
    changes: list[tuple[str, str]] = []
    """Changes, in the order in which they are made. Each change is a pair: a text that occurs once, and the text that
    replaces it.
    """


@dataclass(frozen=True, slots=True)
class TaskFiles:
    """The files of a task."""

    folder: Path
    derived: Mapping[str, Derived]  # by `FOLDER/NAME`
    other: "Callable[[str], TaskFiles]"  # returns the files of another task, by its name

    def read(self, kind: str) -> dict[str, bytes]:
        """Return the name and the contents of each file in one of FOLDERS. Raises BadFile if one of these files cannot
        be derived.
        """
        own = {file.name: read_whole(file) for file in sorted((self.folder / kind).glob("*.*"))}
        made = {
            name.partition("/")[2]: self.text(name).encode()
            for name in self.derived
            if name.startswith(f"{kind}/")
        }
        return own | made

    def text(self, name: str, without: frozenset[str] = frozenset()) -> str:
        """Return the text of the file `FOLDER/NAME`. `without` names the files whose text is being derived from this
        one. Raises BadFile if the file would be derived from itself.
        """
        place = f"{self.folder.name}/{name}"
        if name not in self.derived:
            return read_source(self.folder / name).text
        if place in without:
            raise BadFile(f"{place} is derived from itself")
        one = self.derived[name]
        text = self._source(one.source, without | {place})
        for old, new in one.changes:
            if text.count(old) != 1:
                raise BadFile(f"{place}: {quoted(old)} must occur exactly once in {one.source}")
            text = text.replace(old, new)
        return text

    def _source(self, name: str, without: frozenset[str]) -> str:
        first, _, rest = name.partition("/")
        if first == _PLANS:
            return read_source(plans() / rest).text
        if first in FOLDERS:
            return self.text(name, without)
        return self.other(first).text(rest, without)
