#!/usr/bin/env python3
"""Set handeye up and run it, with nothing but Python 3.11 or newer.

python3 run.py assemble         make .venv, install the locked dependencies, assemble the pump
python3 run.py test             the same, with the test tools, then the test suite
python3 run.py WORD ...         the same as `handeye WORD ...`
"""

import hashlib
import os
import subprocess
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parent
VENV = ROOT / ".venv"
PYTHON = VENV / ("Scripts/python.exe" if os.name == "nt" else "bin/python")


def main(words: list[str]) -> int:
    if sys.version_info < (3, 11):
        print(f"handeye needs Python 3.11 or newer; this is {sys.version.split()[0]}", file=sys.stderr)
        return 2
    testing = words[:1] == ["test"]
    try:
        set_up(ROOT / ("requirements-dev.lock" if testing else "requirements.lock"))
    except subprocess.CalledProcessError as error:
        print(f"setting up failed: {' '.join(map(str, error.cmd))}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        print("\nsetting up was interrupted; the next start completes it", file=sys.stderr)
        return 130
    if not testing:
        return run(["-m", "handeye", *words])
    os.chdir(ROOT)  # a process for each core; what the tests of a file share is made once
    return run(["-m", "pytest", "-n", "auto", "--dist", "loadfile", *words[1:]])


def set_up(lock: Path) -> None:
    """Make the environment hold what `lock` lists, unless a stamp says that it does already."""
    digest = hashlib.sha256(lock.read_bytes() + f"{sys.version}{ROOT}".encode()).hexdigest()
    stamp = VENV / f"{lock.stem}.stamp"
    if PYTHON.exists() and stamp.exists() and stamp.read_text() == digest:
        return
    print(
        f"Setting up {VENV.name} from {lock.name}; this happens once and takes half a minute.",
        file=sys.stderr,
    )
    if not PYTHON.exists():
        make_environment()
    pip = [str(PYTHON), "-m", "pip"] if has_pip() else [sys.executable, "-m", "pip", "--python", str(PYTHON)]
    subprocess.run(
        [*pip, "install", "--quiet", "--disable-pip-version-check", "--require-hashes", "-r", str(lock)],
        check=True,
    )
    site = subprocess.run(
        [str(PYTHON), "-c", "import sysconfig; print(sysconfig.get_path('purelib'))"],
        check=True, capture_output=True, text=True,
    ).stdout.strip()  # fmt: skip
    (Path(site) / "handeye-checkout.pth").write_text(f"{ROOT}\n")
    stamp.write_text(digest)


def make_environment() -> None:
    """A virtual environment; without pip of its own where Debian's python3-venv is missing."""
    made = subprocess.run([sys.executable, "-m", "venv", str(VENV)], capture_output=True)
    if made.returncode != 0:
        subprocess.run([sys.executable, "-m", "venv", "--clear", "--without-pip", str(VENV)], check=True)


def has_pip() -> bool:
    return subprocess.run([str(PYTHON), "-c", "import pip"], capture_output=True).returncode == 0


def run(command: list[str]) -> int:
    """Become the program: its exit code and its answer to Ctrl-C are those of this one."""
    if os.name != "nt":
        os.execv(PYTHON, [str(PYTHON), *command])
    return subprocess.run([str(PYTHON), *command]).returncode


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
