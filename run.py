#!/usr/bin/env python3
"""Set handeye up and run it, with nothing but Python 3.11 or newer.

python3 run.py demo             make .venv, install the locked packages and handeye, show a recorded run
python3 run.py assemble         the same, then assemble the pump
python3 run.py test             the same, with the test tools, then the test suite
python3 run.py test browser     the same, then the checks of the pages in a browser, which needs Chromium
python3 run.py WORD ...         the same as `handeye WORD ...`

Afterwards `.venv/bin/handeye WORD ...` does without this file. Standard output has nothing but what handeye prints.
"""

import hashlib
import os
import shutil
import subprocess
import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import IO

ROOT = Path(__file__).resolve().parent
VENV = ROOT / ".venv"
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")
LOCK, TEST_LOCK = ROOT / "requirements.lock", ROOT / "requirements-dev.lock"
STAMP = VENV / "set-up.stamp"
"""Says what .venv was made from; written last."""
UNFINISHED = VENV / "set-up.unfinished"
"""Is there while .venv is being made or changed: where a start finds it, .venv is made again."""
TURNSTILE = VENV / "set-up.turnstile"
"""Locked by the start that sets up; others wait for it."""
BROWSER = "HANDEYE_CHROMIUM"
"""Names the browser for the checks of the pages."""
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
"""Its default name."""


CALLED = "HANDEYE_CALLED"
"""Names this file to handeye, which then says `python3 run.py report` where it would say `handeye report`."""


class SetUpFailed(Exception):
    """What is the matter, and what to do about it."""


class ProgressLine:
    """One line that says how far the set-up is: on a terminal it changes in place, elsewhere it is written once."""

    def __init__(self, packages: int) -> None:
        self.packages = packages
        self.collected = 0
        self._began = time.monotonic()
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._tell, daemon=True)

    def __enter__(self) -> "ProgressLine":
        if sys.stderr.isatty():
            self._thread.start()
        else:
            say(f"Setting up {VENV.name}: {self.packages} packages. This happens once.")
        return self

    def __exit__(self, kind: object, *how: object) -> None:
        self._over.set()
        if self._thread.is_alive():
            self._thread.join()
        if kind is None:
            say(f"Set up {VENV.name} in {self.seconds} s.")

    @property
    def seconds(self) -> int:
        """Since the set-up began."""
        return round(time.monotonic() - self._began)

    def heard(self, line: str) -> None:
        """A line of pip's."""
        self.collected += line.startswith("Collecting ")

    def _tell(self) -> None:
        while not self._over.wait(0.2):
            done = min(self.collected, self.packages)
            doing = f"{done} of {self.packages} packages fetched" if done < self.packages else "installing"
            line = f"Setting up {VENV.name} (once): {doing}, {self.seconds} s"
            print(f"\r{line:<79.79}", end="", file=sys.stderr, flush=True)
        print(f"\r{'':<79}\r", end="", file=sys.stderr, flush=True)


def main(words: list[str]) -> int:
    if sys.version_info < (3, 11):
        say(f"handeye needs Python 3.11 or newer; this is {sys.version.split()[0]}")
        return 2
    testing = words[:1] == ["test"]
    try:
        set_up(TEST_LOCK if testing else LOCK)
    except SetUpFailed as failure:
        say(f"Setting up failed: {failure}" + ("" if "\n" in str(failure) else "."))
        return 2
    except OSError as error:
        say(f"Setting up failed: {error.filename or VENV}: {error.strerror}.")
        return 2
    except KeyboardInterrupt:
        say("\nSetting up was interrupted; the next start completes it.")
        return 130
    if not testing:
        os.environ[CALLED] = f"{Path(sys.executable).name} {sys.argv[0]}"
        return run(["-m", "handeye", *words])
    os.chdir(ROOT)
    if words[1:2] == ["browser"]:
        return check_in_browser(words[2:])
    # a process for each core; what the tests of a file share is made once
    return run(["-m", "pytest", "-n", "auto", "--dist", "loadfile", *words[1:]])


def check_in_browser(words: list[str]) -> int:
    """The checks that need a browser, which the test suite leaves out."""
    wanted = os.environ.get(BROWSER)
    found = next(filter(None, map(shutil.which, [wanted] if wanted else BROWSERS)), None)
    if found is None:
        named = f"{BROWSER} names {wanted}, which is no program" if wanted else "There is no Chromium here"
        say(f"{named}: on Debian, `apt install chromium` brings what the checks in a browser need.")
        return 2
    os.environ[BROWSER] = found
    checks = sorted(str(check) for check in (ROOT / "tests" / "browser").glob("check_*.py"))
    return run(["-m", "pytest", *checks, *words])


def say(sentence: str) -> None:
    print(sentence, file=sys.stderr, flush=True)


def set_up(lock: Path) -> None:
    """Make the environment hold handeye and what `lock` lists, unless the stamp says that it does already.

    Raises:
        SetUpFailed: it cannot be made.
    """
    if is_set_up(lock):
        return
    VENV.mkdir(exist_ok=True)
    with TURNSTILE.open("a") as turnstile, alone(turnstile):
        if is_set_up(lock):  # by the start that we waited for
            return
        with ProgressLine(lock.read_text().count("==")) as line:
            if UNFINISHED.exists() or not PYTHON.exists():
                empty_environment()
                UNFINISHED.touch()
                make_environment()
            UNFINISHED.touch()
            STAMP.unlink(missing_ok=True)
            install_packages(lock, line)
            install_handeye(line)
            STAMP.write_text(digest(lock))
            UNFINISHED.unlink()


def is_set_up(lock: Path) -> bool:
    """Whether .venv was made from this lock, or from that of the tests, which holds all of the other."""
    if UNFINISHED.exists() or not (PYTHON.exists() and STAMP.exists()):
        return False
    return STAMP.read_text() in {digest(lock), digest(TEST_LOCK)}


def digest(lock: Path) -> str:
    """Of all that an environment is made from: packages, commands and version of handeye, Python, the place."""
    made_from = lock.read_bytes() + (ROOT / "pyproject.toml").read_bytes() + f"{sys.version}{ROOT}".encode()
    return hashlib.sha256(made_from).hexdigest()


@contextmanager
def alone(turnstile: IO[str]) -> Iterator[None]:
    """Holds the lock of a file, which ends with this process however it ends."""
    if not locked(turnstile, wait=False):
        say(f"Another start is setting up {VENV.name}; waiting for it.")
        while not locked(turnstile, wait=True):
            pass
    yield


def locked(file: IO[str], *, wait: bool) -> bool:
    """Whether the lock of a file could be had."""
    try:
        if sys.platform == "win32":
            import msvcrt

            msvcrt.locking(
                file.fileno(), msvcrt.LK_LOCK if wait else msvcrt.LK_NBLCK, 1
            )  # waits 10 s at most
        else:
            import fcntl

            fcntl.flock(file, fcntl.LOCK_EX | (0 if wait else fcntl.LOCK_NB))
    except (BlockingIOError, PermissionError, TimeoutError):
        return False
    return True


def empty_environment() -> None:
    """Take away whatever an interrupted start left."""
    for left in set(VENV.iterdir()) - {TURNSTILE, UNFINISHED}:
        shutil.rmtree(left) if left.is_dir() and not left.is_symlink() else left.unlink()


def make_environment() -> None:
    """A virtual environment; without pip of its own where Debian's python3-venv is missing.

    Raises:
        SetUpFailed: Python cannot make one.
    """
    make = [sys.executable, "-m", "venv", str(VENV)]
    if subprocess.run(make, capture_output=True).returncode == 0:
        return
    made = subprocess.run([*make, "--without-pip"], capture_output=True, text=True, errors="replace")
    if made.returncode != 0:
        raise SetUpFailed(
            f"{sys.executable} could not make {VENV}. It said:\n{(made.stdout + made.stderr).rstrip()}"
        )


def install_packages(lock: Path, line: ProgressLine) -> None:
    """Exactly what the lock lists, by hash.

    Raises:
        SetUpFailed: pip could not.
    """
    code, said = pip(
        "install",
        "--progress-bar=off",
        "--only-binary=:all:",
        "--require-hashes",
        "--requirement",
        str(lock),
        line=line,
    )
    if code != 0:
        raise SetUpFailed(
            f"pip could not install what {lock.name} lists. "
            f"With a connection and 1 GB of free disk, start again: the next start begins from scratch. pip "
            f"said:\n{said}"
        )


def install_handeye(line: ProgressLine) -> None:
    """This folder, editable: the command, the lexer's entry point, the version. Needs no network.

    Raises:
        SetUpFailed: pip could not.
    """
    how = ["--no-index", "--no-deps", "--no-build-isolation"]
    code, said = pip("install", *how, "--editable", str(ROOT), line=line)
    if code != 0:
        raise SetUpFailed(f"pip could not install handeye from {ROOT}. pip said:\n{said}")


def pip(*words: str, line: ProgressLine) -> tuple[int, str]:
    """Run pip of the environment, or this Python's for it: its exit code, and all that it said.

    Raises:
        SetUpFailed: there is none.
    """
    if has_pip(PYTHON):
        command = [str(PYTHON), "-m", "pip"]
    elif has_pip(sys.executable):
        command = [sys.executable, "-m", "pip", "--python", str(PYTHON)]
    else:
        raise SetUpFailed(f"{sys.executable} has no pip; on Debian, `apt install python3-venv` brings it")
    command += ["--disable-pip-version-check", "--no-color"]
    said = []
    with subprocess.Popen(
        [*command, *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace"
    ) as process:
        for text in process.stdout or ():
            said.append(text)
            line.heard(text)
    return process.returncode, "".join(said).rstrip()


def has_pip(python: str | Path) -> bool:
    return subprocess.run([str(python), "-c", "import pip"], capture_output=True).returncode == 0


def run(command: list[str]) -> int:
    """Become the program: its exit code and its answer to Ctrl-C are those of this one."""
    if os.name != "nt":
        os.execv(PYTHON, [str(PYTHON), *command])
    return subprocess.run([str(PYTHON), *command]).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
