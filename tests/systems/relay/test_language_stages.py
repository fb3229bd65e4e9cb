"""Trials of stages by language: what is compared, from which state, and what a row keeps of it."""

import re
from pathlib import Path
from types import SimpleNamespace

import pytest
from msgspec.structs import replace
from pump_bench import put, settle, stacked
from relay_bench import CARRY, pin_relay, runner_of, to_end

from handeye.cli.sweeps import SweepOptions
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.pose import translated
from handeye.judge.finding import at_most
from handeye.program.events import to_line
from handeye.results import judging
from handeye.systems.relay.check import misfits
from handeye.systems.relay.cli import stages as command
from handeye.systems.relay.plan import RelayPlan
from handeye.systems.relay.stages import languages
from handeye.systems.relay.stages import trials as module
from handeye.systems.relay.stages.exchange import exchanged
from handeye.systems.relay.stages.languages import (
    WITHOUT_LEG,
    limits,
    programs,
    relay_of,
    shared,
    stage_legs,
    stages,
)
from handeye.systems.relay.stages.trials import STAGES, StageRow, StageWork, stage_figures
from handeye.tasks.water_pump.cell import build_cell
from handeye.tasks.water_pump.task import WATER_PUMP, WaterPump
from handeye.tasks.water_pump.world.pump_world import PumpWorld
from handeye.trials import sound_run
from handeye.trials.figures import figures
from handeye.trials.folder import read_batch
from handeye.trials.sweep import Case

PINS, GASKET, TOP = "insert the aligning pins", "put on the gasket", "put on the top"


def row(trial: int, language: str, result: str, seconds: float = 1.0) -> StageRow:
    return StageRow(
        trial=trial, seed=trial, condition=f"{PINS}: {language}", of=PINS, language=language, result=result,
        arm_s=seconds, peak_n=2 * seconds, lines=10,
    )  # fmt: skip


ROWS = [
    *(row(k, "1973", "accepted", 50.0) for k in range(4)),
    row(0, "ML", "accepted", 60.0),
    row(1, "ML", "silent"),
    row(2, "ML", "stopped"),
    row(3, "ML", "not reached"),
]


def test_a_cell_counts_its_outcomes_and_leaves_out_worlds_that_the_careful_program_did_not_reach() -> None:
    one, other = STAGES.details(ROWS)[0].cells()
    assert one == (PINS, "1973", "4", "4", "51.0 %", "100.0 %", "0", "0")
    assert other == (PINS, "ML", "1", "3", "6.1 %", "79.2 %", "1", "1")
    costs = STAGES.details(ROWS)[1].cells()
    assert costs[1] == (PINS, "ML", "60.0 s", "120", "120", "10", "0.0 s")  # of accepted trials only
    assert figures(STAGES, ROWS).exit_code == 3


def test_two_languages_are_compared_in_the_worlds_that_both_have_tried() -> None:
    (pair,) = STAGES.details(ROWS)[2].rows
    assert (pair.one, pair.other, pair.pairs) == ("1973", "ML", 3)  # type: ignore[attr-defined]
    assert (pair.only_one, pair.only_other, pair.p) == (2, 0, 0.5)  # type: ignore[attr-defined]
    assert pair.other_takes_s == 10.0  # type: ignore[attr-defined]  # in the one world that both did right


def test_every_stage_says_which_languages_have_a_leg_and_for_what_the_others_have_no_words() -> None:
    found = {each.stage: each for each in limits()}
    assert [*found] == [*stages()]
    assert found["find the base"].languages == "1973"
    assert "LOOK" in found["find the base"].without_words.split(", ")
    assert found[PINS].languages == "1973, TRIG, ML, MAL"
    assert found[PINS].without_words == "CENTER"  # TRIG has no words for RESTORE either, but MAL does
    assert all(each.languages == "1973" for name, each in found.items() if name not in shared())
    assert all(each.without_words for name, each in found.items() if name not in shared())
    with_leg = {(stage, leg.language) for stage in shared() for leg in stage_legs(stage)}
    every = {(stage, language) for stage in shared() for language in ("1973", "TRIG", "ML", "MAL")}
    assert with_leg | {*WITHOUT_LEG} == every
    assert not with_leg & {*WITHOUT_LEG}


def test_the_page_counts_the_lines_for_which_a_language_has_no_words() -> None:
    page = (Path(__file__).parents[3] / "docs" / "four_notations.md").read_text(encoding="utf-8")
    rows = re.findall(
        r"^\| \w+ \| (\d+) \| (\d+), and (\d+) WAIT: .* \| (\d+), and (\d+) WAIT: .* \| (\d+): ", page, re.M
    )
    counted = [
        (int(lines), int(trig) + int(calls), int(ml) + int(ml_calls), int(mal))
        for lines, trig, calls, ml, ml_calls, mal in rows
    ]
    found = {each.stage: each for each in limits()}
    assert counted == [
        (each.lines, each.trig, each.ml, each.mal) for each in (found[stage] for stage in shared())
    ]


def test_remarks_and_blank_lines_are_not_lines_of_a_program() -> None:
    lines = {(leg.stage, leg.language): leg.lines for stage in shared() for leg in stage_legs(stage)}
    assert (lines[PINS, "TRIG"], lines[GASKET, "ML"], lines[TOP, "MAL"]) == (116, 125, 54)


@pytest.mark.slow
def test_each_leg_can_begin_after_the_stages_of_the_careful_program() -> None:
    legs = [leg for stage in shared() for leg in stage_legs(stage)]
    known = programs(legs)
    assert [each.told for leg in legs for each in misfits(relay_of(leg, known))] == []
    assert max(each.cpu_s for each in known.values()) > 0  # the shortest program may take less than a tick


def test_a_stage_or_language_without_a_leg_is_refused_with_the_reason() -> None:
    with pytest.raises(NoSuchName, match="did you mean"):
        command._chosen(["put on the gaskets"], None)
    with pytest.raises(BadArgument, match="no leg in MAL: the line through both finger tips"):
        command._chosen([GASKET], ["MAL"])
    with pytest.raises(BadArgument, match="no leg in TRIG"):
        command._chosen(["find the base"], ["TRIG"])
    assert [leg.condition for leg in command._chosen(None, ["TRIG"])] == [f"{PINS}: TRIG"]


def test_the_careful_program_runs_only_in_worlds_in_which_a_trial_is_missing(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    prepared: list[int] = []

    def prepare(*given: object, **_: object) -> list[object]:
        prepared.extend(world.seed for world in given[2])  # type: ignore[attr-defined]
        return []

    def accept(work: StageWork, case: Case) -> list[StageRow]:
        leg = work.legs[case.condition]
        made = row(case.trials[0], leg.language, "accepted")
        return [replace(made, seed=case.seed, condition=case.condition, of=leg.stage)]

    nothing = RelayPlan(name="none.relay", text="", programs=(), legs=())
    monkeypatch.setattr(languages, "programs", lambda _: {})
    monkeypatch.setattr(languages, "relay_of", lambda *_: nothing)
    monkeypatch.setattr(sound_run, "sound_runs", prepare)
    monkeypatch.setattr(StageWork, "__call__", accept)
    options = SweepOptions(out=tmp_path / "stages", jobs=1)
    for n, only in ((2, ["MAL"]), (3, ["MAL"]), (3, ["MAL", "ML"])):
        assert (
            command.stages(language=only, n=n, seed=5, checkpoints=tmp_path, camera="ray", options=options)
            == 0
        )  # type: ignore[arg-type]
    assert prepared == [5, 6, 7, 5, 6, 7]
    _, kept = read_batch(tmp_path / "stages")
    assert len(kept) == 3 * (2 + 3)
    assert f"no leg: {GASKET}, MAL" in capsys.readouterr().out.replace("\n", " ")


@pytest.mark.slow
def test_a_pin_beside_its_hole_is_refused_while_the_pins_should_stand_in_the_base() -> None:
    cell = build_cell(PumpWorld.nominal(), camera="ray")
    for part, X_WP in stacked().items():
        if part not in ("gasket", "top"):
            put(cell, part, X_WP)
    settle(cell)
    assert [name for name, each in WATER_PUMP.judge_between(cell.truth, 4).items() if each.refuses] == []
    put(cell, "pin0", translated(stacked()["pin0"], (0.02, 0.0, 0.03)))
    wrong = WATER_PUMP.judge_between(cell.truth, 4)
    assert "pins_seated" in [name for name, each in wrong.items() if each.refuses]
    assert WATER_PUMP.judge_between(cell.truth, 3) == WATER_PUMP.judge_between(cell.truth, 9) == {}


@pytest.mark.slow
def test_another_program_continues_from_the_state_that_the_stage_before_left(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    (tmp_path / "one").mkdir()
    (tmp_path / "other").mkdir()
    longer = CARRY.replace("[0 0 1] .2", "[0 0 1] .4")
    one = pin_relay(tmp_path / "one")
    other = pin_relay(tmp_path / "other", carry=longer)
    runner = runner_of(one)
    while runner.system.leg.index < 2:  # type: ignore[attr-defined]
        runner.step()
    handed_over = runner.checkpoint()
    whole = runner_of(other)
    lines = to_end(whole)
    judged = []
    monkeypatch.setattr(module, "findings_after", lambda run, done: judged.append((run, done)) or {})
    figures_of_leg = stage_figures(exchanged(handed_over, other), "carry it on", 3)
    ((again, done),) = judged
    assert [to_line(event).decode() for event in again.events] == lines
    assert done == 3
    assert figures_of_leg["result"] == "accepted"
    assert 1 < figures_of_leg["arm_s"] < 20  # type: ignore[operator]
    assert 0.1 < figures_of_leg["peak_n"] < 80  # type: ignore[operator]


def test_only_findings_that_hold_from_an_earlier_stage_judge_an_unfinished_pump(
    monkeypatch: pytest.MonkeyPatch,
) -> None:
    names = ("base_yaw", "gasket_height", "top_place", "screws", "pins")
    found = {name: at_most(1.0, 0.0, "mm", name) for name in names}
    monkeypatch.setattr(judging, "findings_so_far", lambda _: found)
    monkeypatch.setattr(WaterPump, "judge_between", lambda *_: {"pins_seated": found["pins"]})
    runner = SimpleNamespace(task=WATER_PUMP, cell=SimpleNamespace(truth=None))
    told = [[*judging.findings_after(runner, done)] for done in (3, 5, 7)]  # type: ignore[arg-type]
    assert told == [
        ["base_yaw", "pins_seated"],
        ["base_yaw", "gasket_height", "pins_seated"],
        ["base_yaw", "gasket_height", "top_place", "pins_seated"],
    ]
