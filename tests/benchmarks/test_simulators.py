"""What `python -m benchmarks simulators` measures, and how it shows it."""

import sys
from pathlib import Path

import pytest

from benchmarks import simulators
from benchmarks.simulators import OURS, Cost, Library, lines, measure
from handeye.core.errors import InvalidInput


def cost(library: str, environment: str, cpu_s: float) -> Cost:
    return Cost(
        library=library, environment=environment, versions={"python": "3.12.1", library: "1.2"}, control_hz=60.0,
        timestep_s=0.002, degrees_of_freedom=14, geoms=93, steps=600, cpu_s=cpu_s, contacts=4.5,
    )  # fmt: skip


def test_speed_is_simulated_time_per_processor_time() -> None:
    found = cost("some-library", "Peg", 0.5)
    assert found.steps_per_cpu_s == 1200
    assert found.real_time == 20


def test_the_table_names_environments_and_versions() -> None:
    _, first, second, *versions = lines([cost(OURS, "handeye/Pin-v0", 0.5), cost("some-library", "Peg", 1.0)])
    assert first.split()[:3] == ["handeye/Pin-v0", "1200", "20.0"]
    assert second.split()[:3] == ["Peg", "600", "10.0"]
    assert versions == [
        "handeye: python 3.12.1, handeye 1.2",
        "some-library: python 3.12.1, some-library 1.2",
    ]


@pytest.mark.slow  # one process that imports the simulator and steps a real environment
def test_own_environments_are_stepped_in_a_process_of_their_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    pin = Library(name=OURS, packages=(), environments=("handeye/Pin-v0",))
    monkeypatch.setattr(simulators, "LIBRARIES", (pin,))
    said: list[str] = []
    (found,) = measure(tmp_path, 1, 0.2, said.append)
    assert found.environment == "handeye/Pin-v0"
    assert (found.steps, found.control_hz, found.degrees_of_freedom) == (12, 60.0, 14)
    assert found.cpu_s > 0
    assert said == ["handeye: ready", "round 1 of 1"]


def test_a_library_that_cannot_be_stepped_is_refused_in_a_sentence() -> None:
    fails = "import sys; sys.stderr.write('there is no peg'); sys.exit(3)"
    with pytest.raises(InvalidInput, match=r"^Peg: .* ended with exit code 3: there is no peg$"):
        simulators._run([sys.executable, "-c", fails], "Peg")
