"""How `python -m benchmarks speed` tells what it has measured: to people, to programs, and in docs/figures.md."""

import importlib.util
import json
from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path
from types import ModuleType

import msgspec
import pytest
from conftest import Command
from results import result

from benchmarks.bare_physics import Bare
from benchmarks.growth import Growth
from benchmarks.run_components import COMPONENTS, OTHER
from benchmarks.run_cost import PREPARATION, REFEREE, STAGE, RunCost, Speed, Spent
from benchmarks.speed_page import as_json
from handeye.runs.setup import Setup

DOCS = Path(__file__).parents[2] / "docs"
STAGES = ("lift", "lower")
ALONE = Bare(seconds=2.0, physics_steps=960, stretches=4, same=4, apart_s=None)
RUN = RunCost(
    result=result(completed=True, assembled=True),
    spent=Spent(
        each={
            (PREPARATION, "physics"): 5.0,
            ((STAGE, "lift"), "physics"): 2.0,
            ((STAGE, "lift"), "rendering"): 0.5,
            ((STAGE, "lower"), "vision"): 0.5,
            ((STAGE, "lower"), "servo"): 1.0,
            (REFEREE, OTHER): 0.5,
        }
    ),
    account_cpu_s=0.25,
    bare=ALONE,
)
SPEED = Speed(start_cpu_s=1.0, planning_cpu_s=0.5, stages=STAGES, runs=(RUN,), peak_memory_mib=None)
APART = replace(SPEED, runs=(replace(RUN, bare=replace(ALONE, same=3, apart_s=1.5)),))
REFUSED = replace(SPEED, runs=(replace(RUN, result=msgspec.structs.replace(RUN.result, assembled=False)),))


def told(benchmark: Command, monkeypatch: pytest.MonkeyPatch, found: Speed, *words: str) -> tuple[int, str]:
    """Exit code and answer of the command, if this is what is measured."""
    Path("short.al").write_text("OPEN 1\n", encoding="utf-8")
    monkeypatch.setattr("benchmarks.__main__.default_script", lambda: Path("short.al"))
    monkeypatch.setattr("benchmarks.speed.measure", lambda *_, **__: found)
    code, out, _ = benchmark("speed", *words)
    return code, " ".join(out.split())


def test_a_run_is_told_as_a_multiple_of_its_physics_with_pictures_and_without() -> None:
    assert (RUN.ratio, RUN.ratio_without_pictures) == (2.0, 1.5)


def test_an_hour_of_one_processor_is_reckoned_with_all_that_the_process_took() -> None:
    assert SPEED.cpu_s == 11.0
    assert SPEED.accepted_per_core_hour == pytest.approx(3600 / 11)
    assert REFUSED.accepted_per_core_hour == 0


def test_several_runs_are_told_together() -> None:
    both = replace(SPEED, runs=(RUN, RUN))
    assert both.spent.components("lift")["physics"] == 4.0
    assert both.cpu_s == 20.5


def test_people_are_told_phases_components_and_stages(
    benchmark: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    code, out = told(benchmark, monkeypatch, SPEED)
    assert code == 0
    assert {*COMPONENTS} <= {*out.split()}
    for row in (
        "planning 0.50 4.5%",
        "work 4.00 36.4%",
        "lift 2.50 2.00 0.00 0.00 0.50 0.00 0.00",
        "work took 2.00 times its physics alone (2.00 CPU s), 1.50 without pictures; the replay had the same states as "
        "the run, bit for bit",
        "1 of 1 accepted: 327 per hour of processor time",
        "greatest memory: not measured on this system",
    ):
        assert row in out


@pytest.mark.parametrize(
    ("found", "said"),
    [(APART, "but 1 of 4 stretches of the replay ended in different states, the first at 1.5 s"),
     (REFUSED, "world 0: not right")],
)  # fmt: skip
def test_what_was_not_accepted_or_not_the_same_is_told_and_is_the_exit_code(
    benchmark: Command, monkeypatch: pytest.MonkeyPatch, found: Speed, said: str
) -> None:
    code, out = told(benchmark, monkeypatch, found)
    assert code == 1
    assert said in out


def test_programs_are_told_the_same(benchmark: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    answer = json.loads(told(benchmark, monkeypatch, APART, "--json")[1])
    (world,) = answer["worlds"]
    assert (answer["cpu_s"], answer["work_cpu_s"], answer["peak_memory_mib"]) == (11.0, 4.0, None)
    assert [stage["cpu_s"] for stage in world["stages"]] == [2.5, 1.5]
    assert (world["components"]["physics_cpu_s"], world["preparation"]["physics_cpu_s"]) == (2.0, 5.0)
    assert (world["physics_alone"]["ratio"], world["physics_alone"]["apart_simulated_s"]) == (2.0, 1.5)


def test_the_worlds_are_those_from_the_seed_on(benchmark: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    asked: list[int] = []

    def measure(setups: Sequence[Setup], *_: object, **__: object) -> Speed:
        asked.extend(setup.world.seed for setup in setups)
        return SPEED

    told(benchmark, monkeypatch, SPEED)
    monkeypatch.setattr("benchmarks.speed.measure", measure)
    benchmark("speed", "--seed", "3", "--worlds", "2")
    assert asked == [3, 4]


def test_the_bench_wants_a_world(benchmark: Command) -> None:
    said = "handeye: the number of worlds must be at least 1, not 0\n"
    assert benchmark("speed", "--worlds", "0") == (2, "", said)


def maker() -> ModuleType:
    """The program that writes the tables of the page."""
    spec = importlib.util.spec_from_file_location("make_speed", DOCS / "make_speed.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_has_what_programs_are_told() -> None:
    grown = Growth(what="checked", of="statements", unit="cpu_s", sizes=(1, 10), values=(0.5, 0.509))
    made = maker()
    tables = made.speed(json.loads(msgspec.json.encode(as_json(SPEED))))
    tables += made.growth({"grown": [grown.as_json()]})
    for row in (
        "| seed 0 | accepted | 5.0 s | 4.0 s | 0.5 s | 2.0 s | 2.00 | 1.50 | 4 of 4 stretches |",
        "| lift | 2.50 | 2.00 | 0.00 | 0.00 | 0.00 | 0.50 | 0.00 |",
        "| work | 4.00 | 2.00 | 0.00 | 1.00 | 0.00 | 1.00 | 0.00 |",
        "| accepted pumps per processor hour | 327 |",
        "| checked, CPU s | 0.5000 | 0.5090 | 0.01 | 1,000 µs |",
    ):
        assert row in tables


def test_tables_are_put_between_their_marks() -> None:
    made = maker()
    page = (DOCS / "figures.md").read_text(encoding="utf-8")
    above, below = page.split(made.BEGIN)[0], page.split(made.END)[1]
    assert made.page(page, "| a |\n") == f"{above}{made.BEGIN}\n| a |\n\n{made.END}{below}"
