"""Keeps the ten newest unnamed runs, to which the user gave no name, in the folder `runs` of the current folder.
Each folder is named after the start time of its run.

The environment variable HANDEYE_RUNS names another folder. If the variable is empty, a run is kept only with `--out`.
"""

import os
import shutil
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager, suppress
from datetime import datetime
from itertools import count, islice
from pathlib import Path
from typing import Final

from handeye.core.errors import BadFile, CannotWrite, InvalidInput
from handeye.core.files import LineFile
from handeye.runs.folder import EVENTS, MARK, TRACE, RunFolder, holds_only_a_run, open_new
from handeye.runs.snapshot import Checkpoint

VARIABLE: Final = "HANDEYE_RUNS"
MOST: Final = 10
_IGNORED: Final = "*\n"
"""Content of `.gitignore`: runs are not committed to the repository that contains them."""
_GONE: Final = ".removed-"


def runs_folder() -> Path | None:
    """Return the folder for unnamed runs, or None if none are kept."""
    named = os.environ.get(VARIABLE, "runs")
    return Path(named) if named else None


class UnnamedRun:
    """A folder for an unnamed run. A lock on its mark file keeps other commands from removing the folder until
    the run is closed.
    """

    def __init__(self, home: Path, start: Checkpoint) -> None:
        """Begin a run in `home`, and remove all but the newest ten unnamed runs there. Raises CannotWrite if the
        folder of the run cannot be written.
        """
        try:
            path = _new_place(home, start)
            self._mark = LineFile(path / MARK, "another run", again=False)
            self._mark.append(f"{path.name}\n".encode())
            self.folder: RunFolder = open_new(path, start, unnamed=True)
        except OSError as error:
            raise CannotWrite(f"{home} cannot be written: {error.strerror}") from None
        for old in islice(_newest_first(_unnamed(home)), MOST, None):
            _remove(old)

    @property
    def path(self) -> Path:
        return self.folder.path

    def close(self) -> None:
        """Close the folder. Raises CannotWrite if the trace cannot be completed."""
        try:
            self.folder.close()
        finally:
            self._mark.close()

    def discard(self) -> None:
        """Remove the folder, if the run has not begun."""
        self._mark.close()
        (self.folder.path / MARK).unlink(missing_ok=True)
        self.folder.discard()
        with suppress(OSError):  # the folder holds other runs
            self.folder.path.rmdir()


def newest_run() -> Path | None:
    """Return the newest run in the folder for runs, whether the user named it or not; None if there is no run."""
    home = runs_folder()
    return None if home is None else next(_newest_first(_runs(home)), None)


def newest_runs(number: int) -> list[Path]:
    """Return the newest runs in the folder for runs, named and unnamed. The newest run comes first.
    Raises BadFile if there are fewer than `number` runs.
    """
    home = runs_folder()
    if home is None:
        raise BadFile(
            f"give the folder of a run: no run is saved in `runs`, because the variable {VARIABLE} is empty"
        )
    found = list(islice(_newest_first(_runs(home)), number))
    if len(found) < number:
        there = "no run" if not found else "only one run"
        raise BadFile(
            f"there is {there} in {home}; give the folder of a run, or make a run: handeye assemble"
        )
    return found


def bytes_of(path: Path) -> int:
    """Return the total size of the files in a folder (bytes)."""
    return sum(file.stat().st_size for file in path.rglob("*") if file.is_file())


def _new_place(home: Path, start: Checkpoint) -> Path:
    """Create a new folder with the time and the seed in its name, and return its path."""
    if not home.exists():
        home.mkdir(parents=True)
        (home / ".gitignore").write_text(_IGNORED, encoding="utf-8")
    name = f"{datetime.now():%Y-%m-%d_%H%M%S}_seed{start.setup.world.seed}"
    for number in count(1):
        path = home / (name if number == 1 else f"{name}_{number}")
        with suppress(FileExistsError):
            path.mkdir()
            return path
    raise AssertionError


def _runs(home: Path) -> Iterator[Path]:
    """Yield the folders that contain files of a run."""
    if home.is_dir():
        for path in home.iterdir():
            if not path.name.startswith(".") and any((path / name).is_file() for name in (EVENTS, TRACE)):
                yield path


def _unnamed(home: Path) -> Iterator[Path]:
    """Yield the folders of unnamed runs, without the folders that also contain other files. A run in a renamed folder
    counts as named.
    """
    for path in home.iterdir():
        mark = path / MARK
        if path.is_symlink() or not mark.is_file() or mark.is_symlink():
            continue
        if mark.read_text("utf-8", "replace") == f"{path.name}\n" and holds_only_a_run(path):
            yield path


def _newest_first(runs: Iterator[Path]) -> Iterator[Path]:
    """Return the runs in the order of their last change, the newest first."""
    return iter(sorted(runs, key=lambda path: (_written(path), path.name), reverse=True))


def _written(path: Path) -> int:
    """Return the time of a run's last change (ns)."""
    for name in (EVENTS, TRACE, MARK):
        with suppress(OSError):
            return (path / name).stat().st_mtime_ns
    return 0


def _remove(path: Path) -> None:
    """Remove a run, unless another process is writing to it."""
    with suppress(InvalidInput, OSError), ExitStack() as locks:
        for name in (MARK, EVENTS):
            if (path / name).is_file():
                locks.callback(LineFile(path / name, "another run").close)
        gone = path.with_name(f"{_GONE}{path.name}")
        path.rename(gone)
        shutil.rmtree(gone)


@contextmanager
def held(path: Path) -> Iterator[None]:
    """Within this context, keep other commands from removing the folder, because its run continues."""
    with ExitStack() as lock:
        if (path / MARK).is_file():
            with suppress(InvalidInput):
                lock.callback(LineFile(path / MARK, "another run").close)
        yield
