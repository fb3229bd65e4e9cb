"""The hand-over of pieces from arm to arm: worlds, the program in physics, its referee, planted mistakes, commands."""

import json
import re
from collections.abc import Callable
from pathlib import Path
from typing import Final

import numpy as np
import pytest
from mal_bench import ROOT, mal
from msgspec.structs import replace

from handeye.core.errors import BadArgument, BadFile
from handeye.core.variation import WorldSpec
from handeye.judge.finding import Findings
from handeye.program.numbered import encode
from handeye.results.finishing import finished
from handeye.results.result import Result
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.sigma.gantries.witness import HEARD
from handeye.systems.sigma.gantries.world import GantryWorld
from handeye.systems.sigma.handover.pieces import END_X, MOST, PIN, drawn, pin
from handeye.systems.sigma.handover.task import HANDOVER
from handeye.systems.sigma.handover.witness import HandoverWitness
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.mal.interleavings import Interleavings, interleavings
from handeye.systems.sigma.run.jobs import job_plan, job_setup
from handeye.systems.sigma.run.plan import decode

Command = Callable[..., tuple[int, str, str]]
PAGE: Final = ROOT / "docs/handover.md"
PAGE_TEXT: Final = " ".join(PAGE.read_text(encoding="utf-8").split())
SHOWN: Final = "handeye sigma handover --seed 1 --no-keep"
SHOWN_WORLD: Final = WorldSpec(seed=1)
WORLD: Final = WorldSpec(seed=11)
TEXT: Final = mal("handover_pieces")
ONE: Final = TEXT.replace("1 TO 4", "1 TO 1")


def without(words: str, text: str = TEXT) -> str:
    """A program without the lines that contain some words."""
    return "\n".join(line for line in text.splitlines() if words not in line)


def begun(text: str, pieces: int = 1, world: WorldSpec = WORLD) -> Runner:
    """A board before the first statement."""
    plan = replace(job_plan("handover", pieces), text=text)
    return Runner(Checkpoint(setup=job_setup(plan, world)))


def ended(runner: Runner) -> Result:
    return finished(runner, advance(runner), Meter(), judged=True)


def judged(runner: Runner) -> Findings:
    return HANDOVER.judge(runner.cell.truth)


def wrong(findings: Findings) -> list[str]:
    return [name for name, found in findings.items() if not found.ok]


def test_pieces_are_drawn_near_their_places_and_a_plan_keeps_their_job() -> None:
    for seed in range(20):
        pieces = drawn(GantryWorld(WorldSpec(seed=seed)), MOST)
        assert all(abs(piece.x - 50) <= 1 and abs(piece.height - 40) <= 0.5 for piece in pieces)
        assert [round(piece.y / 60) for piece in pieces] == [1, 2, 3, 4]
    with pytest.raises(BadArgument, match="a hand-over must have 1 to 4 pieces, not 5"):
        drawn(GantryWorld(), 5)
    plan = job_plan("handover", 2)
    assert decode(encode(plan), "kept") == plan
    assert plan.task == "handover"


@pytest.mark.sigma_row(35)
@pytest.mark.slow
def test_four_pieces_are_handed_over_as_the_page_shows(
    command: Command, request: pytest.FixtureRequest
) -> None:
    text = PAGE.read_text(encoding="utf-8")
    code, out, _ = command(*SHOWN.split()[1:])
    assert code == 0
    shown = "".join(f"{line.rstrip()}\n" for line in out.splitlines() if not line.startswith("computer"))
    written = re.sub(rf"(?<=\$ {SHOWN}\n).*?(?=```)", shown, text, count=1, flags=re.DOTALL)
    if request.config.getoption("--update"):
        PAGE.write_text(written, encoding="utf-8")
    else:
        assert written == text


@pytest.mark.sigma_row(40)
@pytest.mark.slow
def test_a_kept_hand_over_goes_on_to_the_same_events_and_result() -> None:
    whole = begun(ONE)
    advance(whole, steps=60)
    second = Runner(whole.checkpoint())
    result = ended(whole)
    assert (result.exit_code, wrong(judged(whole))) == (0, [])
    assert ended(second).figures == result.figures
    assert second.events == whole.events


@pytest.mark.slow
def test_without_its_takes_the_arms_collide_the_reflex_stops_one_and_the_referee_sees_it() -> None:
    runner = begun(without("TAKE"), MOST, SHOWN_WORLD)
    result = ended(runner)
    assert (result.completed, result.exit_code) == (False, 1)
    assert result.message.startswith("ABORT X1 FORCE")
    found = judged(runner)["apart"]
    assert (found.ok, result.message in PAGE_TEXT, f"touch for {found.value:g} ms" in PAGE_TEXT) == (
        False,
        True,
        True,
    )


@pytest.mark.slow
def test_the_planted_race_and_the_planted_deadlock_are_found_in_some_order_of_the_tasks() -> None:
    two = TEXT.replace("TO 4", "TO 2").replace("BY 0.15", "BY 6")  # few steps, and no other difference

    def tried(text: str) -> Interleavings:
        return interleavings(program_of("test.mal", text), 50_000)

    result = tried(two)
    assert (result.complete, result.findings, result.ends) == (True, (), 1)
    assert [each.kind for each in tried(without("500 SET", two)).findings] == ["deadlock"]
    (found, *_) = tried(without("TAKE", two.replace("TO 2", "TO 1"))).findings
    assert (found.kind, found.lines) == ("hands", (170, 340))


@pytest.mark.slow
def test_the_planted_deadlock_stops_the_machine_and_is_named() -> None:
    runner = begun(without("500 SET", TEXT.replace("TO 4", "TO 2")), 2)
    result = ended(runner)
    assert result.exit_code == 1
    assert "DEADLOCK" in result.message
    assert "the task FEEDER, line 160, waits for flag PLACEFREE" in result.message
    assert judged(runner)["apart"].ok


@pytest.mark.slow
def test_a_missing_piece_is_not_counted() -> None:
    runner = begun(TEXT.replace("TO 4", "TO 2"))
    assert (ended(runner).exit_code, wrong(judged(runner))) == (0, [])


@pytest.mark.slow
def test_a_program_that_counts_an_unfinished_piece_fails_in_silence() -> None:
    runner = begun(ONE.replace("< 18 THEN 390", "< 1 THEN 390").replace("DEPTH > 0.2", "DEPTH > -9"))
    assert (ended(runner).exit_code, wrong(judged(runner))) == (3, ["pressed", "counted"])


def test_the_referee_sees_what_is_wrong_with_a_piece_and_a_wrong_count() -> None:
    runner = begun(ONE)
    witness = next(m for m in runner.cell.truth.mechanisms if m.name == HEARD)
    assert isinstance(witness, HandoverWitness)
    (piece,) = drawn(GantryWorld(WORLD), 1)
    data = runner.cell.truth.data
    joint, inner = data.joint(piece.name), data.joint(pin(piece.name))

    def found() -> list[str]:
        runner.cell.restore(runner.cell.capture())
        return wrong(judged(runner))

    assert found() == ["placed", "pressed"]
    joint.qpos[0], inner.qpos[0] = END_X / 1000, PIN / 1000
    assert found() == ["counted"]
    witness.hear("PIECES        1             SECONDS       8.5")
    assert found() == []
    inner.qpos[0] -= 0.0006
    assert found() == ["pressed", "counted"]
    inner.qpos[0] += 0.0006
    joint.qpos[3:7] = (np.cos(0.04), np.sin(0.04), 0, 0)
    assert found() == ["standing", "counted"]
    with pytest.raises(BadFile, match="touched"):
        witness.check(replace(witness.state(), touched_ms=-1))
    with pytest.raises(BadFile, match="differ from the pieces on the board of this world"):
        witness.check(replace(witness.state(), pieces=()))


def test_the_result_of_a_users_own_program_has_the_fields_of_an_assembly(
    command: Command, tmp_path: Path
) -> None:
    file = tmp_path / "own.mal"
    file.write_text('10 PRINT "PIECES", 0\n', encoding="utf-8")
    code, out, _ = command("sigma", "handover", str(file), "--seed", "11", "--no-keep", "--json")
    found = json.loads(out)
    assert (code, found["completed"], found["task"], found["seed"]) == (3, True, "handover", 11)
    assert [name for name, each in found["referee"].items() if not each["ok"]] == ["placed", "pressed"]
    assert found["figures"]["simulated_s"] >= 0


@pytest.mark.parametrize("words", ["nowhere.mal", "--video a.gif", "--out a --no-keep"])
def test_a_hand_over_that_cannot_be_is_refused_in_a_sentence(words: str, command: Command) -> None:
    code, _, err = command("sigma", "handover", *words.split())
    assert (code, "Traceback" in err) == (2, False)
