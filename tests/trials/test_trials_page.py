"""The table of trials in docs/figures.md is that of the files in docs/trials/, and these are what batches have left."""

import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest
from results import result

from handeye.core.faults import Fault
from handeye.core.variation import Overrides, WorldSpec
from handeye.trials.folder import Head
from handeye.trials.plans.row import Row

DOCS = Path(__file__).parents[2] / "docs"
FILES = sorted((DOCS / "trials").glob("*.csv"))


@pytest.fixture(scope="module")
def maker() -> ModuleType:
    """The program that writes the table."""
    spec = importlib.util.spec_from_file_location("make_trials", DOCS / "make_trials.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_table_is_that_of_the_files(maker: ModuleType) -> None:
    page = (DOCS / "figures.md").read_text(encoding="utf-8")
    made = maker.page(page, maker.table([maker.read(file) for file in FILES]))
    assert page == made, "run: python docs/make_trials.py"


@pytest.mark.parametrize("file", FILES, ids=lambda file: file.stem)
def test_no_seed_is_left_out_of_a_file_and_none_counts_twice(maker: ModuleType, file: Path) -> None:
    batch = maker.read(file)
    seeds = [int(trial["seed"]) for trial in batch.trials]
    named = re.search(r"--seeds ([0-9,]+)", batch.facts["command"])
    assert seeds == ([*map(int, named[1].split(","))] if named else [*range(seeds[0], seeds[0] + len(seeds))])


def test_no_world_counts_twice_in_a_sum(maker: ModuleType) -> None:
    batches = [maker.read(file) for file in FILES]
    worlds = [(batch.kind, trial["seed"]) for batch in batches for trial in batch.trials]
    assert len({*worlds}) == len(worlds)


def test_what_a_batch_has_left_is_told_and_added_up(maker: ModuleType, tmp_path: Path) -> None:
    batches = []
    for number, first in enumerate((7, 9)):
        thick = Fault(name="gasket.thick", value=0.003, stage=4)
        spec = WorldSpec(
            seed=first, level="high", faults=(thick,), overrides=Overrides(set={"camera.place.x": 0.00762})
        )
        head = Head(
            kind="assembly", plan="ab" * 8, program="p", world=spec, camera="ray", without=("touch",),
            on_stop="unwind:the pins", simulated_limit_s=3600.0, versions={"handeye": "1"}, code="c",
        )  # fmt: skip
        rows = [
            Row(trial=k, seed=first + k, ended="raised", raised="Bad: luck", cpu_s=1800.0) for k in (0, 1)
        ]
        file = tmp_path / f"{number}.csv"
        file.write_bytes(maker.file_of(head, rows, "c0ffee"))
        batches.append(maker.read(file))
    options = "--set camera.place.x=0.00762m --fault gasket.thick=0.11811in@4 --without touch"
    options += " --on-stop 'unwind:the pins'"
    command = f"handeye trials assembly --n 2 --seed 7 --level high {options} --camera ray --plan p.plan.json"
    assert (batches[0].facts["command"], batches[0].facts["renderer"]) == (command, "ray")
    told = maker.table(batches)
    worlds = f"high {options}"
    assert (
        f"| {worlds} | `abababab` | `{command}` | c0ffee | 0 of 2 | 0 | 0.0% to 65.8% | 0.0% |  | 1.0 |"
        in told
    )
    assert f"| {worlds} | `abababab` | together |  | 0 of 4 | 0 | 0.0% to 49.0% | 0.0% |  | 2.0 |" in told
    assert "| 1 |  | failed | `Bad: luck` | 2 | 9, 10 |" in told


def test_a_file_names_the_renderer_that_was_used_and_seeds_that_were_named(
    maker: ModuleType, tmp_path: Path
) -> None:
    head = Head(
        kind="assembly", plan="ab" * 8, program="water_pump", world=WorldSpec(seed=9), seeds=(9, 3), camera="gl",
        simulated_limit_s=3600.0, versions={"handeye": "1"}, code="c",
    )  # fmt: skip
    made = result(completed=True, assembled=True)
    rows = [Row(trial=k, seed=seed, result=made) for k, seed in enumerate((9, 3))]
    file = tmp_path / "drawn.csv"
    file.write_bytes(maker.file_of(head, rows, "c0ffee"))
    batch = maker.read(file)
    assert batch.facts["renderer"] == made.camera.renderer
    assert batch.facts["command"] == "handeye trials assembly --seeds 9,3 --camera gl"
    assert (batch.whole, [trial["seed"] for trial in batch.trials]) == (True, ["9", "3"])


def test_batches_of_the_same_code_and_level_are_paired_with_the_whole_program(maker: ModuleType) -> None:
    def batch(name: str, words: str, *trials: tuple[str, str], code: str = "c") -> object:
        options = words.partition("--plan")[0]
        facts = {
            "command": f"handeye trials assembly --n 2 --seed 5 {words}".strip(), "commit": "c0ffee", "code": code,
            "plan": "p" if options == words else "other", "worlds": f"nominal {options}".strip(),
        }  # fmt: skip
        rows = [
            {"seed": str(5 + k), "verdict": verdict, "stage": "", "cause": "", "arm_s": arm, "cpu_s": "1"}
            for k, (verdict, arm) in enumerate(trials)
        ]
        return maker.Batch(name, facts, rows)

    right, stopped = ("assembled", "400"), ("stopped", "90")
    told = maker.table(
        [
            batch("whole", "", right, right),
            batch("blind", "--without vision", stopped, ("assembled", "410")),
            batch("once", "--plan once.plan.json", stopped, stopped),
            batch("before", "--without touch", right, right, code="b"),
        ]
    )
    pairs = told.partition(maker.PAIRED)[2].split("\n\n")[0].strip().splitlines()
    assert pairs == [
        "| blind | whole | 1 of 2 | 2 | 0 | 1 | 1 | 1 | 0 | 0 | +10.0 s in 1 | 1 |",
        "| once | whole | 0 of 2 | 2 | 0 | 2 | 0.5 | 2 | 0 | 0 |  |  |",
    ]


def test_other_trials_and_other_pages_are_refused(maker: ModuleType) -> None:
    head = Head(
        kind="dismantling", plan="p", program="p", world=WorldSpec(seed=1), camera="ray", simulated_limit_s=1.0,
        versions={}, code="c",
    )  # fmt: skip
    with pytest.raises(SystemExit, match="no trials of assembling"):
        maker.file_of(head, [], "c0ffee")
    with pytest.raises(SystemExit, match="no place for the table"):
        maker.page("a page", "a table")
    with pytest.raises(SystemExit, match=r"python docs/make_trials\.py"):
        maker.main(["one"])
