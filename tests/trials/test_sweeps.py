"""Whatever is tried: a sweep is kept, gone on with, counted, and compared with another of its kind."""

import json
from pathlib import Path

import pytest
import toy_sweep
from conftest import Command
from cyclopts import App
from toy_sweep import COINS, Coin, throw

from handeye import cli
from handeye.cli.batches import compare_trials
from handeye.core import entries
from handeye.core.entries import Entry
from handeye.core.errors import InvalidInput, NoSuchName
from handeye.core.variation import WorldSpec
from handeye.trials.comparing import paired
from handeye.trials.figures import figures
from handeye.trials.folder import head_of, read_batch, sweep_of
from handeye.trials.plans.trial import ASSEMBLY
from handeye.trials.sweep import carry_out, cases, processes
from handeye.trials.text import failures

ENTRY = Entry(
    name="coins", title="Coins", help="Throw coins.", system="toy_sweep:NONE", sweeps={"coins": "toy_sweep:COINS"}
)  # fmt: skip


def thrown(*seeds: int) -> tuple[Coin, ...]:
    return tuple(row for seed in seeds for row in carry_out(COINS, throw, cases(seed, [0]), processes(1)))


@pytest.fixture
def coins(request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch) -> Command:
    """The command line of a computer on which the toy is installed."""
    monkeypatch.setitem(entries._registered, "coins", ENTRY)
    app, trials = App(name="handeye", suppress_keyboard_interrupt=False), App(name="trials")
    for name, function in (("coins", toy_sweep.coins), ("compare", compare_trials)):
        trials.command(function, name=name)
    app.command(trials)
    monkeypatch.setattr(cli, "app", app)
    found: Command = request.getfixturevalue("command")
    return found


def test_a_kind_of_elsewhere_is_found_by_the_entry_of_its_system(monkeypatch: pytest.MonkeyPatch) -> None:
    assert sweep_of("assembly") is ASSEMBLY
    with pytest.raises(
        NoSuchName, match=r"^there are no trials of the kind `coins` here; the kinds are `?assembly"
    ):
        sweep_of("coins")
    monkeypatch.setitem(entries._registered, "coins", ENTRY)
    assert sweep_of("coins of silver") is COINS


def test_outcomes_count_as_their_kind_says_and_what_broke_off_counts_against_it() -> None:
    rows = thrown(0, 1, 2, 7)
    found = figures(COINS, rows, lambda row: f"again {row.seed}")
    assert (found.n, found.right, found.uncounted, found.failed, found.exit_code) == (3, 1, 1, 1, 0)
    assert found.outcomes == {"heads": 1, "tails": 1, "rolled away": 1, "failed": 1}
    assert (found.measures["height, m"].n, found.measures["height, m"].most) == (2, 0.1)
    assert [(each.verdict, each.cause, each.command) for each in found.failures] == [
        ("tails", "", "again 1"), ("failed", "ValueError: there is no coin", "again 7"),
    ]  # fmt: skip
    assert [*failures(found)][::2] == [
        "trial 0, seed 1: tails", "trial 0, seed 7: failed, ValueError: there is no coin",
        "1 of 3: ValueError: there is no coin",
    ]  # fmt: skip


def test_a_sweep_of_which_every_trial_broke_off_is_no_success() -> None:
    assert figures(COINS, thrown(7, 7)).exit_code == 1
    assert figures(COINS, thrown(7, 1)).exit_code == 0
    assert figures(COINS, ()).exit_code == 0


def test_conditions_are_counted_apart() -> None:
    both = carry_out(COINS, throw, cases(0, range(3), ("silver", "gold")), processes(1))
    found = figures(COINS, both)
    assert [(each.condition, each.n, each.right) for each in found.conditions] == [
        ("silver", 2, 1),
        ("gold", 2, 1),
    ]
    assert (found.n, found.right) == (4, 2)


def test_batches_of_one_kind_are_compared_and_of_two_are_not() -> None:
    head = head_of(COINS, WorldSpec(seed=0))
    other = head_of(ASSEMBLY, WorldSpec(seed=0))
    with pytest.raises(InvalidInput, match=r"^b holds trials of another kind: assembly, not coins$"):
        paired(["a", "b"], [(head, ()), (other, ())])


@pytest.mark.slow
def test_its_command_keeps_each_trial_and_goes_on_and_a_killed_process_costs_nothing(coins: Command) -> None:
    """Two processes at a time: the one that is killed in the world of seed 13 is begun once more."""
    words = ("trials", "coins", "--seed", "12", "--jobs", "2", "--out", "kept", "--json")
    code, out, _ = coins(*words, "--n", "2")
    assert (code, json.loads(out)["killed"]) == (0, 1)
    code, out, err = coins(*words, "--tables", "csv")
    assert (code, "2 of 4 throws already done by an earlier command" in err) == (0, True)
    assert [row.side for row in read_batch(Path("kept"))[1]] == ["heads", "tails", "rolled away", "heads"]
    assert {"figures.html", "tables", "trials.jsonl"} <= {path.name for path in Path("kept").iterdir()}
    code, out, _ = coins("trials", "compare", "kept", "kept", "--json")
    (same,) = json.loads(out)
    assert (code, same["pairs"], same["right"], same["measures"]["height, m"]["more"]) == (0, 3, 2, 0)
