"""The folder of an agent: the only place in which the agent's calls read and write files."""

import os
import re
from dataclasses import dataclass
from itertools import count
from pathlib import Path
from typing import Final, Self

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, BadFile, CannotWrite
from handeye.core.source import Source, read_source

NAME: Final = "handeye-agent"  # of a new folder under the current one
_PART: Final = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_. -]{0,63}")
_RUN: Final = re.compile(r"[A-Za-z0-9_][A-Za-z0-9_-]{0,39}")
_DEEPEST: Final = 8  # parts of a file's name


@dataclass(frozen=True, slots=True)
class AgentFolder:
    """A folder with the scripts and runs of one agent."""

    root: Path  # resolved

    @classmethod
    def at(cls, path: Path | None) -> Self:
        """Open a folder, which is created if it does not exist. If `path` is None, a new folder is created in the
        current folder. Raises CannotWrite if the folder cannot be created.
        """
        chosen = path or _new_folder(Path.cwd())
        try:
            chosen.mkdir(parents=True, exist_ok=True)
            if not os.access(chosen, os.W_OK | os.X_OK):
                raise CannotWrite(f"{chosen} cannot be written to")
        except OSError as error:
            raise CannotWrite(f"the folder {chosen} cannot be created: {error.strerror}") from None
        return cls(chosen.resolve())

    def source(self, name: str) -> Source:
        """Read a text file of the folder. Raises InvalidInput if the name leads out of the folder, or if the file
        cannot be read.
        """
        try:
            text = read_source(self.path(name)).text
        except BadFile as error:
            raise BadFile(str(error).replace(str(self.root) + os.sep, "")) from None
        return Source(name=name, text=text)

    def has(self, name: str) -> bool:
        """Return True if the folder has a file of this name. Raises BadArgument if the name leads out of the folder."""
        return self.path(name).is_file()

    def run(self, name: str) -> Path:
        """Return the folder of a run. Raises BadArgument if no run can have this name, or if the run's folder contains
        a link.
        """
        if not _RUN.fullmatch(name):
            raise BadArgument(
                f"a run cannot be called {quoted(name)}: use up to 40 letters, digits, - and _, such as run-1"
            )
        path = self.path(f"runs/{name}")
        if any(place.is_symlink() for place in path.rglob("*")):
            raise BadArgument(f"the folder of the run {name} holds a link, which is not followed")
        return path

    def free_run(self) -> str:
        """Return a name that no run of the folder has."""
        return next(name for n in count(1) if not os.path.lexists(self.path("runs") / (name := f"run-{n}")))

    def runs(self) -> list[str]:
        """Return the names of the runs in the folder, sorted."""
        return sorted(path.name for path in self.path("runs").glob("*/") if _RUN.fullmatch(path.name))

    def path(self, name: str) -> Path:
        """Return the path of a file in the folder. The file may not exist yet. Raises BadArgument if the name is not
        relative, or if it leads out of the folder, directly or through a link.
        """
        parts = name.split("/")
        if len(parts) > _DEEPEST or not all(map(_PART.fullmatch, parts)):
            raise BadArgument(
                f"{quoted(name)} is not a file in the agent's folder: give its name in this folder, such as pin.al or "
                "tries/pin.al, with letters, digits, dots, - and _"
            )
        place = self.root
        for part in parts:
            place = place / part
            if place.is_symlink():
                raise BadArgument(f"{quoted(name)} is or contains a link, which is not followed")
        return place


def _new_folder(parent: Path) -> Path:
    """Return a path under `parent` at which nothing exists."""
    names = (NAME if n == 1 else f"{NAME}-{n}" for n in count(1))
    return next(path for name in names if not os.path.lexists(path := parent / name))
