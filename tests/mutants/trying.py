"""Tries faults in a copy of the project: which test fails first, or that none does."""

import json
import os
import shutil
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final, Literal

import first_failure
from hatchling.builders.sdist import SdistBuilder
from mutant_table import Mutant

ROOT: Final = Path(__file__).resolve().parents[2]
SLACK: Final = 120.0
"""s that a fault may take besides: starting pytest, and a computer that has other things to do."""
FACTOR: Final = 5.0
"""How many times as long as without a fault its tests may take."""

Ending = Literal[
    "caught", "caught elsewhere", "out of time", "survived", "survived as told", "caught after all"
]


class TryingError(Exception):
    """Tests could not be run, so that nothing is known of a fault."""


class Stopped(Exception):
    """Somebody does not want to wait any longer."""


@dataclass(frozen=True, slots=True, kw_only=True)
class Outcome:
    """Outcome of a fault."""

    mutant: Mutant
    ending: Ending
    test: str | None
    """The test that failed first."""
    seconds: float

    @property
    def expected(self) -> bool:
        """It is as the table says; a fault with which a test does not end is caught by whoever waits."""
        late = self.ending == "out of time" and bool(self.mutant.caught_by)
        return late or self.ending in ("caught", "survived as told")


@dataclass(frozen=True, slots=True, kw_only=True)
class Session:
    """What came of one start of pytest."""

    failed: str | None = None
    late: bool = False
    seconds: dict[str, float] = field(default_factory=dict)
    """Of the tests of each file."""


class Copy:
    """A copy of the project in a folder of its own, in which one thing at a time is tried."""

    def __init__(self, folder: Path, stop: threading.Event) -> None:
        self.root, self._stop = folder / "project", stop
        self._told = folder / "told.json"
        _copy_project(self.root)

    def session(self, tests: Sequence[str], limit: float | None = None) -> Session:
        """Run tests until one fails, or for so long (s).

        Raises:
            TryingError: pytest itself could not go on, or ran other code than this copy's.
            Stopped: meanwhile somebody asked for that.
        """
        words = ["-x", "-q", "-p", "first_failure", "-p", "no:cacheprovider", "-p", "no:xdist", *tests]
        self._told.unlink(missing_ok=True)
        process = subprocess.Popen(
            [sys.executable, "-m", "pytest", *words],
            cwd=self.root, env=self._environment(), start_new_session=True,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
        )  # fmt: skip
        output = _waited(process, limit, self._stop)
        if output is None:
            return Session(late=True)
        told = json.loads(self._told.read_text(encoding="utf-8")) if self._told.exists() else {"failed": None}
        if process.returncode != 0 and told["failed"] is None:
            raise TryingError(
                f"pytest ended with {process.returncode} on {' '.join(tests)}:\n{output[-2000:]}"
            )
        if Path(told["code"]) != self.root:
            raise TryingError(f"the tests ran the code in {told['code']}, not that of the copy")
        return Session(failed=told["failed"], seconds=told["seconds"])

    def faulty(self, mutant: Mutant, tests: Sequence[str], limit: float) -> Session:
        """A session with a fault in the code."""
        file = self.root / mutant.file
        sound = file.read_text(encoding="utf-8")
        try:
            rewrite(file, mutant.put_into(sound))
            return self.session(tests, limit)
        finally:
            rewrite(file, sound)

    def _environment(self) -> dict[str, str]:
        path = os.pathsep.join((str(self.root), str(Path(__file__).parent)))
        return {**os.environ, "PYTHONPATH": path, first_failure.PLACE: str(self._told), "PYTEST_ADDOPTS": ""}


@dataclass(slots=True)
class Unmutated:
    """How long tests take without a fault; they have to pass, or else no failure means anything."""

    named: dict[str, float] = field(default_factory=dict)
    """Of the tests that faults name, by file."""
    whole: dict[str, float] = field(default_factory=dict)
    """Of all tests of a file or folder."""
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def check(self, copy: Copy, tests: Sequence[str]) -> None:
        """Run tests by their names, and note how long those of each file take.

        Raises:
            TryingError: one of them fails.
        """
        self.named.update(_passing(copy, tests))

    def limit(self, copy: Copy, test: str) -> float:
        """How long a test by its name, or a whole file or folder, may take with a fault in the code, s.

        Raises:
            TryingError: it has not been run before, and fails.
        """
        place, _, name = test.partition("::")
        known = self.named if name else self.whole
        if place not in known:
            with self._lock:  # whoever else needs it waits for the first to have measured it
                if place not in known:
                    known[place] = sum(_passing(copy, [test]).values())
        return SLACK + FACTOR * known[place]


def _passing(copy: Copy, tests: Sequence[str]) -> dict[str, float]:
    """How long the tests of each file take, s.

    Raises:
        TryingError: one of them fails.
    """
    session = copy.session(tests)
    if session.failed is not None:
        raise TryingError(f"{session.failed} fails without any fault")
    return session.seconds


def tried(mutant: Mutant, copy: Copy, sound: Unmutated) -> Outcome:
    """Put a fault in and run its test; if that does not fail, the wider ones.

    Raises:
        TableError, TryingError, Stopped: nothing is known of it.
    """
    begun = time.monotonic()

    def outcome(ending: Ending, test: str | None = None) -> Outcome:
        return Outcome(mutant=mutant, ending=ending, test=test, seconds=time.monotonic() - begun)

    for test in (mutant.caught_by, *mutant.wider):
        if not test:
            continue
        session = copy.faulty(mutant, [test], sound.limit(copy, test))
        if session.late:
            return outcome("out of time", test)
        if session.failed is not None:
            named = session.failed.partition("[")[0] == mutant.caught_by
            ending: Ending = (
                "caught" if named else "caught elsewhere" if mutant.caught_by else "caught after all"
            )
            return outcome(ending, session.failed)
    return outcome("survived as told" if mutant.survives else "survived")


def _copy_project(root: Path) -> None:
    """Copy what a source distribution holds, which is all that the tests need."""
    for file in SdistBuilder(str(ROOT)).recurse_included_files():
        copy = root / file.distribution_path
        copy.parent.mkdir(parents=True, exist_ok=True)
        shutil.copy(file.path, copy)


def rewrite(file: Path, code: str) -> None:
    """Change a file, and forget what was compiled of it: Python knows an old one by its size and second only."""
    file.write_text(code, encoding="utf-8")
    for compiled in (file.parent / "__pycache__").glob(f"{file.stem}.*.pyc"):
        compiled.unlink()


def _waited(process: subprocess.Popen[str], limit: float | None, stop: threading.Event) -> str | None:
    """The output of a process that has ended; None: it was killed, with all its children, as the time was over.

    Raises:
        Stopped: it was killed since `stop` was set.
    """
    end = None if limit is None else time.monotonic() + limit
    try:
        while not stop.is_set():
            try:
                return process.communicate(timeout=0.5)[0]
            except subprocess.TimeoutExpired:
                if end is not None and time.monotonic() > end:
                    return None
        raise Stopped
    finally:
        if process.poll() is None:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
