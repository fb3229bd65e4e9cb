"""What `python -m benchmarks growth` measures, and how it tells what is linear."""

import json
from collections.abc import Callable, Iterator

import pytest
from conftest import Command

from benchmarks.growth import Growth
from benchmarks.growth_costs import cells, script, statements
from handeye.al import AL
from handeye.core.source import Source
from handeye.planning.planner import plan_source
from handeye.program.taught import load_taught
from handeye.runs.scripts import default_script
from handeye.tasks import task

SIZES = (1, 10, 100, 1000, 10000)


def growth(cost: Callable[[int], float]) -> Growth:
    return Growth(
        what="checked", of="statements", unit="cpu_s", sizes=SIZES, values=tuple(map(cost, SIZES))
    )  # fmt: skip


@pytest.mark.parametrize(
    ("cost", "power"),
    [(lambda n: 3e-5 * n, 1.0), (lambda n: 1e-9 * n**2, 2.0), (lambda n: 0.5, 0.0), (lambda n: 0.0, 0.0)],
)
def test_the_power_is_that_by_which_cost_grows(cost: Callable[[int], float], power: float) -> None:
    assert growth(cost).power == pytest.approx(power, abs=1e-9)


def test_what_is_done_once_neither_hides_a_square_nor_makes_one() -> None:
    assert not growth(lambda n: 1e-3 + 1e-6 * n + 1e-8 * n**2).is_linear
    assert growth(lambda n: 1e-3 + 1e-5 * n).is_linear


@pytest.mark.parametrize("number", [1, 60, 250])
def test_a_measured_program_has_its_statements_and_nothing_is_said_about_it(number: int) -> None:
    taught = load_taught(default_script().with_suffix(".toml"))
    made = plan_source(
        Source(name="growth.al", text=script(number)), taught, task().arm, AL, task="water_pump"
    )
    assert script(number).count("\n") == number
    assert made.plan is not None
    assert made.diagnostics == []


@pytest.mark.slow
def test_everything_that_statements_and_cells_cost_is_measured() -> None:
    costs = {**statements(2), **cells(1)}
    assert {unit for _, unit in costs} == {"cpu_s", "mib"}
    assert min(costs.values()) > 0


LINEAR, SQUARE = growth(lambda n: 2e-5 * n), growth(lambda n: 1e-9 * n**2)


def told(benchmark: Command, monkeypatch: pytest.MonkeyPatch, found: Growth, *words: str) -> tuple[int, str]:
    """Exit code and answer of the command, if this is what is measured."""

    def measure(most: int, told: Callable[[str], None]) -> Iterator[Growth]:
        told(f"{most} statements")
        yield found

    monkeypatch.setattr("benchmarks.growth.measure", measure)
    code, out, _ = benchmark("growth", *words)
    return code, out


def test_the_bench_tells_people_what_one_costs_at_each_size(
    benchmark: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    code, out = told(benchmark, monkeypatch, LINEAR)
    head, checked, each, *_ = out.splitlines()
    assert code == 0
    assert head.split() == ["statements", "1", "10", "100", "1,000", "10,000", "power"]
    assert checked.split() == [
        "checked,",
        "CPU",
        "s",
        "0.0000",
        "0.0002",
        "0.0020",
        "0.0200",
        "0.2000",
        "1.00",
    ]
    assert each.split() == ["µs", "each", *["20"] * 5]


def test_the_bench_ends_with_one_if_something_grows_faster(
    benchmark: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    code, out = told(benchmark, monkeypatch, SQUARE, "--json")
    (found,) = json.loads(out)["grown"]
    assert (code, found["linear"], found["power"]) == (1, False, pytest.approx(2))
    assert found["cpu_s"] == pytest.approx(SQUARE.values)


@pytest.mark.parametrize("most", ["0", "10001"])
def test_the_bench_wants_programs_that_there_can_be(benchmark: Command, most: str) -> None:
    said = f"handeye: a program has 1 to 10000 statements, not {most}\n"
    assert benchmark("growth", "--most", most) == (2, "", said)
