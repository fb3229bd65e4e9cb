#!/usr/bin/env python3
"""Set up handeye and run it. This needs only Python 3.11 or newer.

python3 run.py demo             set up .venv with the locked packages and handeye, then show a recorded run
python3 run.py assemble         set up .venv, then assemble the pump
python3 run.py test             set up .venv with the test tools, then run the test suite
python3 run.py test browser     set up .venv likewise, then check the pages in a browser, which needs Chromium
python3 run.py docs             set up .venv-docs with the packages for the site, then build the documentation in site/
python3 run.py WORD ...         set up .venv, then run `handeye WORD ...`

Once .venv is set up, `.venv/bin/handeye WORD ...` works without this file. Only handeye writes to standard output.
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
from dataclasses import dataclass
from pathlib import Path
from typing import IO

ROOT = Path(__file__).resolve().parent
LOCK, TEST_LOCK, SITE_LOCK = (ROOT / f"requirements{kind}.lock" for kind in ("", "-dev", "-docs"))
BROWSER = "HANDEYE_CHROMIUM"
"""Environment variable that gives the browser for the checks of the pages."""
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
"""Browsers to look for if that variable is not set."""


CALLED = "HANDEYE_CALLED"
"""Environment variable that tells handeye how it was called. The messages of handeye then show `python3 run.py
report` instead of `handeye report`.
"""


class SetUpFailed(Exception):
    """Raised when an environment cannot be set up; the message says why, and what to do about it."""


@dataclass(frozen=True)
class Environment:
    """A virtual environment of this folder, and the files that record its state."""

    folder: Path

    @property
    def python(self) -> Path:
        return self.folder / ("Scripts/python.exe" if os.name == "nt" else "bin/python")

    @property
    def stamp(self) -> Path:
        """Records what the environment was made from; written last."""
        return self.folder / "set-up.stamp"

    @property
    def unfinished(self) -> Path:
        """Exists while the environment is being made or changed. If it exists when run.py starts, the environment
        is made again.
        """
        return self.folder / "set-up.unfinished"

    @property
    def turnstile(self) -> Path:
        """Locked by the process that sets up the environment; other processes wait for the lock."""
        return self.folder / "set-up.turnstile"


VENV, SITE_VENV = Environment(ROOT / ".venv"), Environment(ROOT / ".venv-docs")


class ProgressLine:
    """A line that shows the progress of the set-up. On a terminal the line is updated in place; elsewhere one
    message is written.
    """

    def __init__(self, name: str, packages: int) -> None:
        self.name = name
        self.packages = packages
        self.collected = 0
        self._began = time.monotonic()
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._tell, daemon=True)

    def __enter__(self) -> "ProgressLine":
        if sys.stderr.isatty():
            self._thread.start()
        else:
            say(f"Setting up {self.name}: {self.packages} packages. This happens once.")
        return self

    def __exit__(self, kind: object, *how: object) -> None:
        self._over.set()
        if self._thread.is_alive():
            self._thread.join()
        if kind is None:
            say(f"Set up {self.name} in {self.seconds} s.")

    @property
    def seconds(self) -> int:
        """Seconds since the set-up began."""
        return round(time.monotonic() - self._began)

    def heard(self, line: str) -> None:
        """Note a line of pip's output."""
        self.collected += line.startswith("Collecting ")

    def _tell(self) -> None:
        while not self._over.wait(0.2):
            done = min(self.collected, self.packages)
            doing = f"{done} of {self.packages} packages fetched" if done < self.packages else "installing"
            line = f"Setting up {self.name} (once): {doing}, {self.seconds} s"
            print(f"\r{line:<79.79}", end="", file=sys.stderr, flush=True)
        print(f"\r{'':<79}\r", end="", file=sys.stderr, flush=True)


def main(words: list[str]) -> int:
    if sys.version_info < (3, 11):
        say(f"handeye needs Python 3.11 or newer; this is {sys.version.split()[0]}")
        return 2
    testing, documenting = words[:1] == ["test"], words == ["docs"]
    try:
        if documenting:
            set_up(SITE_VENV, SITE_LOCK)
        else:
            set_up(VENV, TEST_LOCK if testing else LOCK)
    except SetUpFailed as failure:
        say(f"Setting up failed: {failure}" + ("" if "\n" in str(failure) else "."))
        return 2
    except OSError as error:
        say(f"Setting up failed: {error.filename or ROOT}: {error.strerror}.")
        return 2
    except KeyboardInterrupt:
        say("\nSetting up was interrupted; run the command again to complete it.")
        return 130
    if documenting:
        return run([str(ROOT / "docs" / "make_site.py")], SITE_VENV)
    if not testing:
        os.environ[CALLED] = f"{Path(sys.executable).name} {sys.argv[0]}"
        return run(["-m", "handeye", *words])
    os.chdir(ROOT)
    if words[1:2] == ["browser"]:
        return check_in_browser(words[2:])
    # one process per core; one process runs all tests of a file, so that what they share is made only once
    return run(["-m", "pytest", "-n", "auto", "--dist", "loadfile", *words[1:]])


def check_in_browser(words: list[str]) -> int:
    """Run the checks that need a browser, which the test suite leaves out."""
    wanted = os.environ.get(BROWSER)
    found = next(filter(None, map(shutil.which, [wanted] if wanted else BROWSERS)), None)
    if found is None:
        named = f"{BROWSER} names {wanted}, which is not a program" if wanted else "There is no Chromium here"
        say(f"{named}: on Debian, `apt install chromium` installs what the checks in a browser need.")
        return 2
    os.environ[BROWSER] = found
    checks = sorted(str(check) for check in (ROOT / "tests" / "browser").glob("check_*.py"))
    return run(["-m", "pytest", *checks, *words])


def say(sentence: str) -> None:
    print(sentence, file=sys.stderr, flush=True)


def set_up(environment: Environment, lock: Path) -> None:
    """Install handeye and the packages that `lock` lists, unless the stamp says that they are installed.

    Raises:
        SetUpFailed: the environment cannot be set up.
    """
    if is_set_up(environment, lock):
        return
    environment.folder.mkdir(exist_ok=True)
    with environment.turnstile.open("a") as turnstile, alone(turnstile, environment):
        if is_set_up(environment, lock):  # by the process that we waited for
            return
        with ProgressLine(environment.folder.name, lock.read_text().count("==")) as line:
            if environment.unfinished.exists() or not environment.python.exists():
                empty(environment)
                environment.unfinished.touch()
                make(environment)
            environment.unfinished.touch()
            environment.stamp.unlink(missing_ok=True)
            install_packages(environment, lock, line)
            install_handeye(environment, line)
            environment.stamp.write_text(digest(lock))
            environment.unfinished.unlink()


def is_set_up(environment: Environment, lock: Path) -> bool:
    """Return True if the environment was made from this lock file, or from the lock file of the tests, which lists
    every package that the lock file of the program lists.
    """
    if environment.unfinished.exists() or not (environment.python.exists() and environment.stamp.exists()):
        return False
    return environment.stamp.read_text() in {digest(lock), digest(TEST_LOCK)}


def digest(lock: Path) -> str:
    """Compute a digest of everything that an environment is made from: the packages, handeye's commands and
    version, the version of Python, and the folder.
    """
    made_from = lock.read_bytes() + (ROOT / "pyproject.toml").read_bytes() + f"{sys.version}{ROOT}".encode()
    return hashlib.sha256(made_from).hexdigest()


@contextmanager
def alone(turnstile: IO[str], environment: Environment) -> Iterator[None]:
    """Hold the lock of a file while the context is open. The lock ends with this process, however the process
    ends.
    """
    if not locked(turnstile, wait=False):
        say(f"Another process is setting up {environment.folder.name}; waiting for it to finish.")
        while not locked(turnstile, wait=True):
            pass
    yield


def locked(file: IO[str], *, wait: bool) -> bool:
    """Try to lock a file. Returns True if this succeeds."""
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


def empty(environment: Environment) -> None:
    """Delete whatever an interrupted set-up left."""
    for left in set(environment.folder.iterdir()) - {environment.turnstile, environment.unfinished}:
        shutil.rmtree(left) if left.is_dir() and not left.is_symlink() else left.unlink()


def make(environment: Environment) -> None:
    """Make the virtual environment. It has no pip of its own if Debian's python3-venv is missing.

    Raises:
        SetUpFailed: Python cannot make an environment.
    """
    command = [sys.executable, "-m", "venv", str(environment.folder)]
    if subprocess.run(command, capture_output=True).returncode == 0:
        return
    made = subprocess.run([*command, "--without-pip"], capture_output=True, text=True, errors="replace")
    if made.returncode != 0:
        raise SetUpFailed(
            f"{sys.executable} could not make {environment.folder}. It said:\n{(made.stdout + made.stderr).rstrip()}"
        )


def install_packages(environment: Environment, lock: Path, line: ProgressLine) -> None:
    """Install exactly what the lock file lists, checked by hash.

    Raises:
        SetUpFailed: pip could not install them.
    """
    code, said = pip(
        environment,
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
            f"pip could not install the packages that {lock.name} lists. Make sure that there is a network "
            f"connection and 1 GB of free disk space, then run the command again; it begins from scratch. pip "
            f"said:\n{said}"
        )


def install_handeye(environment: Environment, line: ProgressLine) -> None:
    """Install this folder as an editable package, with its command, its version and the entry point of its lexer.
    This needs no network.

    Raises:
        SetUpFailed: pip could not install it.
    """
    how = ["--no-index", "--no-deps", "--no-build-isolation"]
    code, said = pip(environment, "install", *how, "--editable", str(ROOT), line=line)
    if code != 0:
        raise SetUpFailed(f"pip could not install handeye from {ROOT}. pip said:\n{said}")


def pip(environment: Environment, *words: str, line: ProgressLine) -> tuple[int, str]:
    """Run the environment's pip, or else this Python's pip, on the environment. Returns the exit code and all
    output.

    Raises:
        SetUpFailed: there is no pip.
    """
    if has_pip(environment.python):
        command = [str(environment.python), "-m", "pip"]
    elif has_pip(sys.executable):
        command = [sys.executable, "-m", "pip", "--python", str(environment.python)]
    else:
        raise SetUpFailed(f"{sys.executable} has no pip; on Debian, `apt install python3-venv` installs it")
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


def run(command: list[str], environment: Environment = VENV) -> int:
    """Replace this process by a command of the environment's Python, so that exit code and Ctrl-C are those of the
    command. On Windows, run the command and return its exit code.
    """
    python = str(environment.python)
    if os.name != "nt":
        os.execv(python, [python, *command])
    return subprocess.run([python, *command]).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
