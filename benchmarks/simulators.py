"""Measures how fast the environments of several libraries run, each library in a virtual environment of its own.

Times of this computer vary by tens of percent with whatever else it does. So each round steps every environment once,
in turn, and the figures are medians over the rounds.
"""

import json
import subprocess
import sys
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import msgspec

from handeye.core.errors import InvalidInput
from handeye.core.record import Record

_ROOT: Final = Path(__file__).parents[1]
_WORKER: Final = Path(__file__).with_name("simulator_worker.py")

OURS: Final = "handeye"


@dataclass(frozen=True, slots=True, kw_only=True)
class Library:
    """A library of environments, and the packages with which it runs."""

    name: str
    packages: tuple[str, ...]
    environments: tuple[str, ...]


LIBRARIES: Final = (
    Library(
        name=OURS, packages=(), environments=("handeye/Pin-v0", "handeye/GasketAndTop-v0", "handeye/Pump-v0")
    ),
    Library(
        name="gymnasium-robotics",
        # with MuJoCo 4, its arms fail an assertion about the types of joints
        packages=("gymnasium-robotics==1.4.2", "mujoco==3.3.7"),
        environments=("FetchPickAndPlace-v4",),
    ),
    Library(
        name="robosuite",
        packages=("robosuite==1.5.2", "mujoco==3.3.7"),  # likewise
        environments=("NutAssembly", "Stack"),
    ),
    Library(
        name="metaworld",
        packages=(
            "metaworld==3.1.1",
            "mujoco==3.3.0",
            "packaging",
        ),  # it needs the last one and does not say so
        environments=("peg-insert-side-v3",),
    ),
)


class Cost(Record, frozen=True, kw_only=True):
    """What one environment is, and what its steps cost."""

    library: str
    environment: str
    versions: dict[str, str]
    control_hz: float  # steps of the environment in a second of simulated time
    timestep_s: float  # time step of the physics, s
    degrees_of_freedom: int
    geoms: int
    steps: int
    cpu_s: float  # processor time of these steps, s
    contacts: float  # mean number after a step

    @property
    def steps_per_cpu_s(self) -> float:
        """Steps of the environment in a second of processor time."""
        return self.steps / self.cpu_s

    @property
    def real_time(self) -> float:
        """Simulated seconds in a second of processor time."""
        return self.steps_per_cpu_s / self.control_hz


def measure(folder: Path, rounds: int, seconds: float, done: Callable[[str], None]) -> Iterator[Cost]:
    """Yield the cost of each environment: the round with the median cost.

    Args:
        folder: keeps the virtual environments; those that are there are used again.
        rounds: number of rounds; each steps every environment once.
        seconds: simulated time of the steps, s.
        done: is called with a line after each step of the work.

    Raises:
        InvalidInput: a library cannot be installed, or an environment cannot be stepped.
    """
    pythons = {}
    for library in LIBRARIES:
        pythons[library.name] = _installed(library, folder)
        done(f"{library.name}: ready")
    found: dict[tuple[str, str], list[Cost]] = {}
    for number in range(rounds):
        for library in LIBRARIES:
            for name in library.environments:
                cost = _stepped(pythons[library.name], library.name, name, seconds)
                found.setdefault((library.name, name), []).append(cost)
        done(f"round {number + 1} of {rounds}")
    for costs in found.values():
        yield sorted(costs, key=lambda cost: cost.cpu_s)[len(costs) // 2]


def lines(costs: list[Cost]) -> Iterator[str]:
    """Yield a table, and the versions of the packages."""
    yield (
        f"{'environment':26} {'steps per CPU s':>15} {'times real time':>15} {'control':>8} {'timestep':>9} "
        f"{'d.o.f.':>6} {'geoms':>5} {'contacts':>8}"
    )
    for cost in costs:
        yield (
            f"{cost.environment:26} {cost.steps_per_cpu_s:15.0f} {cost.real_time:15.1f} {cost.control_hz:5.0f} Hz "
            f"{cost.timestep_s * 1e3:6.2f} ms {cost.degrees_of_freedom:6} {cost.geoms:5} {cost.contacts:8.1f}"
        )
    for library, versions in {cost.library: cost.versions for cost in costs}.items():
        yield f"{library}: " + ", ".join(f"{name} {version}" for name, version in versions.items())


def _installed(library: Library, folder: Path) -> Path:
    """Return the interpreter with which a library is used; install the library if it is missing."""
    if library.name == OURS:
        return Path(sys.executable)
    home = folder / library.name
    python, ready = home / "bin" / "python", home / "ready"
    wanted = "\n".join(library.packages)
    if not ready.exists() or ready.read_text(encoding="utf-8") != wanted:
        _run([sys.executable, "-m", "venv", "--clear", str(home)], library.name)
        _run([str(python), "-m", "pip", "install", "--quiet", *library.packages], library.name)
        ready.write_text(wanted, encoding="utf-8")
    return python


def _stepped(python: Path, library: str, name: str, seconds: float) -> Cost:
    out = _run([str(python), "-P", str(_WORKER), library, name, str(seconds)], name)
    return msgspec.convert(json.loads(out), Cost)


def _run(command: list[str], what: str) -> str:
    """Run a command from the root of the checkout, and return its output."""
    ran = subprocess.run(  # noqa: S603 - commands of this file
        command,
        cwd=_ROOT,
        env={"PATH": "/usr/bin:/bin", "PYTHONPATH": str(_ROOT), "HOME": str(Path.home())},
        capture_output=True,
        text=True,
        check=False,
    )
    if ran.returncode:
        last = (ran.stderr.strip().splitlines() or ["no output"])[-1]
        raise InvalidInput(f"{what}: {command[0]} ended with exit code {ran.returncode}: {last}")
    return ran.stdout
