"""The paper's order of tests leads each fault to its part; the game, and what a player types."""

import json
import shlex
from collections.abc import Callable
from pathlib import Path
from typing import Final

import pytest
from import_reading import imports
from mal_bench import ROOT
from walked_pages import walked, with_outputs

from handeye.core.errors import InvalidInput
from handeye.execution.servo import Halted
from handeye.systems.sigma.bus.faults import defect
from handeye.systems.sigma.diagnosis.bench import Bench
from handeye.systems.sigma.diagnosis.faults import FAULTS, Planted, planted
from handeye.systems.sigma.diagnosis.game import MEANS, Game, known_part
from handeye.systems.sigma.diagnosis.report import diagnosed
from handeye.systems.sigma.diagnosis.strategy import Strategy, Verdict
from handeye.systems.sigma.protocol import NUMBERS

Command = Callable[..., tuple[int, str, str]]
PAGE: Final = ROOT / "docs/diagnosis.md"
DIAGNOSIS: Final = ROOT / "handeye/systems/sigma/diagnosis"
KNOWN: Final = (
    "handeye.core.", "handeye.ports.microbus", "handeye.systems.sigma.protocol", "handeye.systems.sigma.bus.layout",
    "handeye.systems.sigma.diagnosis.means", "handeye.systems.sigma.diagnosis.power_on",
)  # fmt: skip


def of_bus(text: str, seed: int = 0) -> Verdict:
    """What the diagnosis says of a fault of the bus."""
    return Strategy(Bench(Planted(fault="", part="", told="", bus=(defect(text),)), seed)).diagnose()


def played(seed: int, text: str) -> tuple[Game, list[str]]:
    """A game, and what it says to some lines."""
    told: list[str] = []
    game = Game(told.append, seed)
    for line in text.splitlines():
        try:
            game.hear(line)
        except InvalidInput as error:
            told.append(str(error))
    return game, told


@pytest.mark.sigma_row(51)
@pytest.mark.parametrize("fault", FAULTS)
def test_each_of_twenty_faults_is_led_to_its_part(fault: str) -> None:
    found = diagnosed(fault, None)
    assert (found.verdict.part, len(FAULTS)) == (found.part, 20)


@pytest.mark.sigma_row(51)
@pytest.mark.slow
@pytest.mark.parametrize("seed", [12])
def test_wherever_a_fault_is_drawn_no_other_part_is_accused(seed: int) -> None:
    """Among these are addresses that two microcomputers answer to, and status lines that no test shows."""
    found = [diagnosed(fault, seed) for fault in FAULTS]
    assert [each.told for each in found if not each.right and not each.undecided] == []
    assert sum(each.right for each in found) >= 17


def test_a_sound_machine_has_no_fault() -> None:
    assert Strategy(Bench(seed=4)).diagnose().part == ""


@pytest.mark.sigma_row(51)
def test_the_computer_comes_first_then_the_bus_then_microcomputers_then_transducers() -> None:
    typed: list[str] = []
    Strategy(Bench(), lambda line, _: typed.append(line)).diagnose()
    words = [line.split()[0] for line in typed]
    first = {word: words.index(word) for word in words}
    assert sorted(first, key=lambda word: first[word]) == [
        "selftest", "clocks", "strobe", "force", "beam", "grip", "origin", "rail", "moves", "load", "together",
    ]  # fmt: skip


@pytest.mark.sigma_row(51)
@pytest.mark.parametrize("fault", ["status-a:FORCE1:0", "status-b:FORCE2:1", "status-a:HAND2:0"])
def test_a_line_that_no_test_shows_is_reported_as_not_decidable(fault: str) -> None:
    verdict = of_bus(fault)
    assert verdict.part == ""
    assert "Line A of a wrist or hand may be stuck low" in verdict.why


@pytest.mark.sigma_row(38)
@pytest.mark.parametrize(
    ("fault", "part"),
    [
        ("clock:Y2:-60", "microcomputer Y2"),  # no byte is misread
        ("status-a:Z1:0", "status line A of Z1"),
        ("status-b:X2:0", "status line B of X2"),
        ("status-b:HAND1:0", "status line B of HAND1"),
        ("long-strobe:28", "computer"),
        ("dead-interface:0", "segment 0"),
    ],
)
def test_the_right_part_is_named_though_another_one_suffers(fault: str, part: str) -> None:
    assert of_bus(fault).part == part


@pytest.mark.sigma_row(38)
@pytest.mark.parametrize(
    ("name", "number", "seed"),
    [("HAND1", 1, 2), ("Z1", 0, 4), ("FORCE2", 1, 3)],  # a wrist is always busy; the seeds garble the answers
)
def test_of_two_that_answer_to_one_number_the_stranger_is_named(name: str, number: int, seed: int) -> None:
    assert of_bus(f"address:{name}:{number}", seed).part == f"microcomputer {name}"


def test_a_spare_microcomputer_brings_its_own_converter_and_leaves_the_gauges() -> None:
    for fault, cured in (("converter", True), ("gauge", False)):
        there = planted(fault)
        bench = Bench(there)
        bench.swap(NUMBERS["FORCE1"])
        assert (Strategy(bench).diagnose().part == "") is cured


def test_tests_and_order_know_the_bus_and_not_the_fault() -> None:
    found = {
        f"{name}: {each}"
        for name in ("means", "strategy", "power_on")
        for each in imports((DIAGNOSIS / f"{name}.py").read_text("utf-8"), f"systems.sigma.diagnosis.{name}")
        if each.startswith("handeye.") and not each.startswith(KNOWN)
    }
    assert found == set()


def test_the_order_of_the_paper_plays_the_game_to_its_end(command: Command) -> None:
    code, out, _ = command("sigma", "diagnose", "--demo", "--seed", "3")
    assert code == 0
    assert (
        "> accuse fingers of hand 1\nRight: the fingers of hand 1 take .4 s to close. You used 7 tests" in out
    )


def test_a_player_tests_asks_swaps_and_accuses() -> None:
    game, told = played(
        5, "status\nask x1\nask HAND1\nmoves X2\nswap X1\nparts\nhelp\naccuse Low  switch of x1"
    )
    assert (game.won, game.over, game.tests) == (True, True, 5)
    assert told[0].startswith("X1 0-0, Y1 0-0, Z1 0-0, FORCE1 0-1, HAND1 0-0")
    assert told[1:5] == [
        "X1 is at step 0", "HAND1 answers to its self-test 0", "at full speed: steps lost: X2 0",
        "a spare microcomputer replaces the microcomputer of X1; the machine was switched off and on",
    ]  # fmt: skip
    assert told[-1].startswith("Right: the low switch of X1 is stuck off. You used 5 tests")


def test_a_wrong_accusation_loses_the_game() -> None:
    game, told = played(5, "accuse supply")
    assert (game.won, game.over) == (False, True)
    assert told == [
        "Wrong: the low switch of X1 is stuck off. You used 0 tests; the order of tests in the paper finds the part "
        "after 11 tests."
    ]


def test_a_player_runs_a_program(tmp_path: Path) -> None:
    file = tmp_path / "mine.mal"
    file.write_text("10 ORIGIN X1\n20 PRINT POS(X1)\n")
    game, told = played(5, f"run {file}\nquit")
    assert told == [
        "ABORT X1 RAIL 0.04: the task MAIN, line 10",
        "The fault: the low switch of X1 is stuck off.",
    ]
    assert (game.tests, game.over, game.won) == (1, True, False)


@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("acuse supply", "`acuse` is not a test or a command of this game; did you mean `accuse`?"),
        ("force", "the form is `force ARM`"),
        ("clocks X1", "the form is `clocks`"),
        ("force 3", "the arm must be 1 or 2, not `3`"),
        ("rail Q1", "there is no axis `Q1`; the axes are X1, Y1"),
        ("swap 77", "there is no microcomputer `77`; the microcomputers are X1"),
        ("accuse the suply", "there is no part `the suply`; "),
        ("run nothing.mal", "nothing.mal"),
    ],
)
def test_what_a_player_cannot_do_is_said_in_a_sentence_and_is_no_test(line: str, why: str) -> None:
    game, told = played(5, line)
    assert why in " ".join(told)
    assert (game.tests, game.over) == (0, False)


def test_every_part_that_can_have_a_fault_can_be_accused() -> None:
    for fault in FAULTS:
        for seed in (None, *range(30)):
            part = planted(fault, seed).part
            assert known_part(part.upper()) == part
    assert all(hasattr(Game, f"_{word}") for word in MEANS)


@pytest.mark.parametrize(
    ("words", "why"),
    [
        ("--fault nonsense", "there is no fault `nonsense`; the faults are bit, interface"),
        ("--fault bit --all", "--fault, --all and --game exclude each other"),
        ("--game --json", "--json does not apply to a game"),
    ],
)
def test_options_that_make_no_sense_are_refused(words: str, why: str, command: Command) -> None:
    code, _, err = command("sigma", "diagnose", *words.split())
    assert code == 2
    assert why in " ".join(err.split())


def test_a_diagnosis_is_told_as_json(command: Command) -> None:
    code, out, _ = command("sigma", "diagnose", "--fault", "clock", "--json")
    found = json.loads(out)["figures"]
    assert (code, found["verdict"]["part"], found["planted"]["part"]) == (0, *["microcomputer X1"] * 2)
    assert [each["test"] for each in found["tests"]] == ["selftest", "clocks"]


@pytest.mark.slow
def test_the_page_shows_what_its_commands_print(
    command: Command, request: pytest.FixtureRequest, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("handeye.cli.common.screen.width", 150)

    def run(line: str) -> tuple[int, str]:
        code, out, _ = command(*shlex.split(line))
        return code, out

    typed = walked(PAGE.read_text(encoding="utf-8"), run)
    if request.config.getoption("--update"):
        PAGE.write_text(with_outputs(PAGE.read_text(encoding="utf-8"), typed), encoding="utf-8")
        return
    assert [each.line for each in typed if each.code != 0] == []
    assert [(each.line, each.printed) for each in typed if not each.stands] == []
    assert len(typed) == 3


def test_a_program_without_an_end_can_be_stopped(tmp_path: Path) -> None:
    passes = iter([False] * 100)

    def poll() -> None:
        if next(passes, True):
            raise Halted

    file = tmp_path / "loop.mal"
    file.write_text("10 GOTO 10\n")
    told: list[str] = []
    Game(told.append, 6, poll).hear(f"run {file}")
    assert told == ["stopped at 0.200 s"]
