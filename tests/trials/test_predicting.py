"""Predictions are counted, told, held against whole trials, and the worst worlds of them are carried out."""

import csv
import json
from pathlib import Path

import numpy as np
import pytest
from conftest import Command
from results import result

import handeye
from handeye.core.errors import InvalidInput
from handeye.core.variation import WorldSpec
from handeye.planfile.store import read_plan
from handeye.results.result import Check
from handeye.tasks.interface import Predicted
from handeye.trials.batch import batch as carrying_out
from handeye.trials.batch.batch import head_of
from handeye.trials.batch.contacts import SearchEnd
from handeye.trials.batch.folder import BatchFolder
from handeye.trials.batch.row import Row
from handeye.trials.batch.trial import Trial
from handeye.trials.prediction import predicting
from handeye.trials.prediction.figures import figures, worst_of
from handeye.trials.prediction.predicting import Prediction, predict

WORLD = WorldSpec(seed=10)
PIN = Predicted(
    operation="pin", at="T", what="off", unit="mm", off=np.array([1.0, 5.0, 2.0, 0.0]), room=4.0,
    places=np.array([1.0, 9.0, 4.0, 1.0]),
)  # fmt: skip
TOP = Predicted(
    operation="top", at="TOPON", what="lies off", unit="mm", off=np.array([0.1, 0.2, 0.9, 0.3]), room=1.0,
    finding="top_place",
)  # fmt: skip
FOUR = Prediction(world=WORLD, seeds=(10, 11, 12, 13), each=(PIN, TOP))


def row(seed: int, *, assembled: bool, places: int, lies: float) -> Row:
    """A whole trial that has ended, as a batch keeps it."""
    check = Check(
        ok=True, subject="top", value=lies, relation="at most", limit=1, unit="mm", sentence="top (at most 1 mm)"
    )  # fmt: skip
    found = result(completed=True, assembled=assembled, checks={"top_place": check})
    search = SearchEnd(at="T", places=places, found=True)
    return Row(trial=seed - 10, seed=seed, ended="ended", result=found, searches=(search, search))


ROWS = (
    row(10, assembled=True, places=1, lies=0.15),
    row(11, assembled=False, places=9, lies=0.5),
    row(12, assembled=False, places=5, lies=0.8),
)


def test_an_operation_has_its_median_its_tail_and_the_worlds_in_which_it_does_not_fit() -> None:
    pin, top = figures(FOUR, str, worst=1).operations
    assert (pin.median, pin.worst, pin.worst_seed, pin.used, pin.beyond) == (1.5, 5.0, 11, 1.25, 0.25)
    assert (top.median, top.worst, top.worst_seed, top.used, top.beyond) == (0.25, 0.9, 12, 0.9, 0.0)
    assert pin.p95 == pytest.approx(4.55)


def test_the_worst_worlds_are_those_that_use_most_of_any_room() -> None:
    found = figures(FOUR, lambda seed: f"again {seed}", worst=3)
    told = [(each.seed, each.operation, each.used, each.command) for each in found.worst]
    assert told == [(11, "pin", 1.25, "again 11"), (12, "top", 0.9, "again 12"), (13, "top", 0.3, "again 13")]
    assert found.beyond == 0.25
    assert worst_of(FOUR, 9) == [1, 2, 3, 0]


def test_whole_trials_are_counted_beside_what_was_predicted_of_them() -> None:
    found = figures(FOUR, str, worst=1, rows=ROWS).outcome
    assert found is not None
    assert (found.n, found.predicted, found.failed, found.both, found.silent) == (3, 1, 2, 1, 2)
    places, lies = found.agreements
    assert (places.name, places.n, places.correlation, places.predicted, places.measured) == (
        "pin, T", 3, 1.0, 4.0, 5.0,
    )  # fmt: skip
    assert (places.close, lies.name, lies.n) == (1.0, "top_place", 3)
    assert lies.close == pytest.approx(2 / 3)


def test_the_same_is_predicted_in_any_number_of_processes(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(predicting, "CHUNK", 15)
    program = handeye.plan(handeye.scripts / "water_pump.al").record.program
    seeds = range(500, 540)
    one, two = (predict(program, WORLD, seeds, workers=workers) for workers in (1, 2))
    assert all((a.off == b.off).all() for a, b in zip(one.each, two.each, strict=True))
    assert one.used.tolist() == two.used.tolist()


def test_from_python_worlds_are_a_table() -> None:
    found = handeye.trials.predict(handeye.World(7, level="high"), 30)
    table, worlds = found.table(), found.worlds()
    assert (len(worlds), worlds["seed"][0]) == (30, 7)
    at = [*table["at"]].index("T1")
    assert table["worst"][at] == pytest.approx(worlds["pin 1, T1: off"].max(), abs=1e-5)
    assert repr(found).startswith("<30 worlds, ")
    with pytest.raises(InvalidInput, match=r"^there is no sense `smell`; there are vision, "):
        handeye.trials.predict(lacking=["smell"])
    with pytest.raises(InvalidInput, match=r"^faults are not predicted"):
        handeye.trials.predict(handeye.World(7, faults=["lamp.dead"]))


def test_the_command_tells_leaves_tables_and_takes_the_options_of_worlds(command: Command) -> None:
    words = ("trials", "predict", "--n", "40", "--seed", "5", "--worst", "3", "--workers", "1")
    code, out, err = command(*words, "--level", "high", "--out", "found", "--json")
    told = json.loads(out)
    assert (code, told["n"], len(told["worst"])) == (0, 40, 3)
    assert "40 of 40 worlds predicted" in err
    assert told["worst"][0]["command"].endswith("--level high")
    with Path("found/prediction/worlds.csv").open() as file:
        assert [int(line["seed"]) for line in csv.DictReader(file)] == [*range(5, 45)]
    low = json.loads(command(*words, "--level", "low", "--json")[1])
    assert low["beyond"] < told["beyond"]
    assert command(*words)[1].splitlines()[-1].endswith("% of 40 worlds")


def test_the_worst_worlds_are_simulated_and_kept(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    """With trials that nobody carries out: in each the program is silent about a failure."""
    asked = []

    def carried(trial, jobs, engine, *, folder, told) -> tuple[Row, ...]:
        asked.append([job.world.seed for job in jobs])
        rows = tuple(row(job.world.seed, assembled=False, places=1, lies=0.1) for job in jobs)
        for each in rows:
            folder.append(each)
            told(each)
        return rows

    monkeypatch.setattr(carrying_out, "carry_out", carried)
    words = (
        "trials",
        "predict",
        "--n",
        "40",
        "--worst",
        "2",
        "--workers",
        "1",
        "--simulate",
        "--out",
        "found",
    )
    code, out, err = command(*words, "--json")
    told = json.loads(out)
    assert (code, told["outcome"]["n"], told["outcome"]["silent"]) == (3, 2, 2)
    assert asked == [[each["seed"] for each in told["worst"]]]
    assert "2 of 2  seed" in err
    assert len(Path("found/trials/trials.jsonl").read_text().splitlines()) == 3


def test_a_kept_batch_is_held_against_its_prediction(command: Command) -> None:
    plan = read_plan(handeye.scripts / "water_pump.plan.json")
    trial = Trial(plan=plan)
    folder = BatchFolder(Path("batch"), head_of(trial, WORLD), plan)
    for each in ROWS:
        folder.append(each)
    folder.close()
    told = json.loads(command("trials", "predict", "--against", "batch", "--json")[1])
    assert (told["n"], told["outcome"]["n"], told["outcome"]["failed"]) == (3, 3, 2)
    assert command("trials", "predict", "--against", "batch", "--simulate")[::2] == (
        2, "handeye: --against takes plan and trials of its folder: leave --plan and --simulate out\n",
    )  # fmt: skip


@pytest.mark.parametrize(
    ("words", "told"),
    [
        (("--n", "0"), "at least one world is needed; 0 is too few"),
        (("--workers", "0"), "at least one process is needed; 0 is too few"),
        (("--n", "3", "--without", "force"), "the prediction takes motions to end where they should"),
        (("--against", "nowhere"), "nowhere holds no batch of trials"),
    ],
)
def test_what_cannot_be_predicted_is_told_in_a_sentence(
    command: Command, words: tuple[str, ...], told: str
) -> None:
    code, _, err = command("trials", "predict", *words)
    assert code == 2
    assert told in err
