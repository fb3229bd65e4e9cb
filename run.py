#!/usr/bin/env python3
"""Set handeye up and run it, with nothing but Python 3.11 or newer.

python3 run.py assemble         make .venv, install the locked packages and handeye, assemble the pump
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
"""Is there while .venv is being made or changed: where a start finds it, .venv is made anew."""
TURNSTILE = VENV / "set-up.turnstile"
"""Locked by the start that sets up; others wait for it."""
BROWSER = "HANDEYE_CHROMIUM"
"""Names the browser for the checks of the pages."""
BROWSERS = ("chromium", "chromium-browser", "google-chrome")
"""What it is called where nobody names it."""


class SetUpFailed(Exception):
    """What is the matter, and what to do about it."""


def main(words: list[str]) -> int:
    if sys.version_info < (3, 11):
        say(f"handeye needs Python 3.11 or newer; this is {sys.version.split()[0]}")
        return 2
    testing = words[:1] == ["test"]
    try:
        set_up(TEST_LOCK if testing else LOCK)
    except SetUpFailed as failure:
        say(f"Setting up failed: {failure}.")
        return 2
    except OSError as error:
        say(f"Setting up failed: {error.filename or VENV}: {error.strerror}.")
        return 2
    except KeyboardInterrupt:
        say("\nSetting up was interrupted; the next start completes it.")
        return 130
    if not testing:
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
        say(
            f"Setting up {VENV.name} from {lock.name}. This happens once and takes half a minute;\n"
            "where network or disk is slow, minutes."
        )
        if UNFINISHED.exists() or not PYTHON.exists():
            empty_environment()
            UNFINISHED.touch()
            make_environment()
        UNFINISHED.touch()
        STAMP.unlink(missing_ok=True)
        install_packages(lock)
        install_handeye()
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
    if subprocess.run([*make, "--without-pip"], stdout=sys.stderr).returncode != 0:
        raise SetUpFailed(f"{sys.executable} could not make {VENV}, for the reason above")


def install_packages(lock: Path) -> None:
    """Exactly what the lock lists, by hash.

    Raises:
        SetUpFailed: pip could not.
    """
    progress = [] if sys.stderr.isatty() else ["--quiet"]
    if pip("install", *progress, "--only-binary=:all:", "--require-hashes", "--requirement", str(lock)) != 0:
        raise SetUpFailed(
            f"pip could not install what {lock.name} lists, for the reason above. "
            "With a connection and 1 GB of free disk, start again: the next start begins anew"
        )


def install_handeye() -> None:
    """This folder, editable: the command, the lexer's entry point, the version. Needs no network.

    Raises:
        SetUpFailed: pip could not.
    """
    how = ["--quiet", "--no-index", "--no-deps", "--no-build-isolation"]
    if pip("install", *how, "--editable", str(ROOT)) != 0:
        raise SetUpFailed(f"pip could not install handeye from {ROOT}, for the reason above")


def pip(*words: str) -> int:
    """Run pip of the environment, or this Python's for it; all that it says goes to standard error.

    Raises:
        SetUpFailed: there is none.
    """
    if has_pip(PYTHON):
        command = [str(PYTHON), "-m", "pip"]
    elif has_pip(sys.executable):
        command = [sys.executable, "-m", "pip", "--python", str(PYTHON)]
    else:
        raise SetUpFailed(f"{sys.executable} has no pip; on Debian, `apt install python3-venv` brings it")
    return subprocess.run([*command, "--disable-pip-version-check", *words], stdout=sys.stderr).returncode


def has_pip(python: str | Path) -> bool:
    return subprocess.run([str(python), "-c", "import pip"], capture_output=True).returncode == 0


def run(command: list[str]) -> int:
    """Become the program: its exit code and its answer to Ctrl-C are those of this one."""
    if os.name != "nt":
        os.execv(PYTHON, [str(PYTHON), *command])
    return subprocess.run([str(PYTHON), *command]).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
