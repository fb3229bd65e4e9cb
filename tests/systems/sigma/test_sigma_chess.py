"""The chess experiment: boards, the program in physics, its referee, its commands, and its page."""

import json
import re
from collections.abc import Callable
from itertools import pairwise
from pathlib import Path
from typing import Final

import numpy as np
import pytest
from gantry_bench import Machine
from mal_bench import ROOT, mal
from msgspec.structs import replace

from handeye.core import resources
from handeye.core.errors import BadArgument, BadFile
from handeye.core.processor import processor
from handeye.core.variation import WorldSpec
from handeye.judge.finding import Findings
from handeye.program.events import to_line
from handeye.program.numbered import encode
from handeye.results.finishing import finished
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.sigma.chess.pieces import BY_HEIGHT, LIMITS, drawn
from handeye.systems.sigma.chess.task import CHESS, HEIGHT
from handeye.systems.sigma.gantries.machine import Gantries
from handeye.systems.sigma.gantries.world import GantryWorld
from handeye.systems.sigma.run.jobs import job_plan, job_setup
from handeye.systems.sigma.run.plan import MOST_PIECES, MalPlan, decode
from handeye.trace.compare import compared
from handeye.trace.reading import read_trace
from handeye.trials.jobs import JobRow, JobWork
from handeye.trials.sweep import Case

Command = Callable[..., tuple[int, str, str]]
PAGE: Final = ROOT / "docs/chess.md"
SHOWN: Final = "handeye sigma chess --pieces 3 --seed 4 --no-keep"
FEW: Final = WorldSpec(seed=11)


def begun(text: str | None = None, pieces: int = 1) -> Runner:
    """A board before the first statement."""
    plan = job_plan("chess", pieces)
    if text is not None:
        plan = replace(plan, text=text)
    return Runner(Checkpoint(setup=job_setup(plan, FEW)))


def test_a_drawn_board_has_room_for_a_hand_between_its_pieces_and_no_height_near_a_limit() -> None:
    for seed in range(40):
        for count in (1, 8, MOST_PIECES):
            pieces = drawn(GantryWorld(WorldSpec(seed=seed)), count)
            assert len(pieces) == count
            assert all(abs(piece.height - limit) > 2 * HEIGHT for piece in pieces for limit in LIMITS)
            for one, two in pairwise(pieces):
                assert one.line != two.line or two.x - one.x > one.radius + two.radius + 29.9
            assert all(30 < piece.x - piece.radius + 0.01 < 365 for piece in pieces)
            assert {piece.goal for piece in pieces} <= {*BY_HEIGHT}
    with pytest.raises(BadArgument, match="a board must have 1 to 12 pieces, not 13"):
        drawn(GantryWorld(), 13)


@pytest.mark.sigma_row(30)
@pytest.mark.slow
def test_three_pieces_are_found_measured_and_put_on_their_lines_as_the_page_and_the_recorded_run_show(
    command: Command, request: pytest.FixtureRequest
) -> None:
    text = PAGE.read_text(encoding="utf-8")
    code, out, _ = command(*SHOWN.replace("--no-keep", "--out again").split()[1:])
    assert code == 0
    shown = "".join(f"{line.rstrip()}\n" for line in out.splitlines() if not line.startswith("computer"))
    written = re.sub(rf"(?<=\$ {SHOWN}\n).*?(?=```)", shown, text, count=1, flags=re.DOTALL)
    if request.config.getoption("--update"):
        PAGE.write_text(written, encoding="utf-8")
    else:
        assert written == text
    recorded = read_trace(resources.demo() / "chess/trace.mcap")
    if recorded.head.versions.get("processor", processor()) == processor():
        found = compared(recorded, read_trace(Path("again/trace.mcap")), events=len(recorded.events))
        assert (found.parts, found.rounded) == (None, None), "run: python docs/make_demo.py chess"


@pytest.mark.slow
def test_the_result_of_a_board_has_the_fields_of_an_assembly_and_figures(command: Command) -> None:
    code, out, _ = command("sigma", "chess", "--pieces", "1", "--seed", "11", "--no-keep", "--json")
    found = json.loads(out)
    assert (code, found["assembled"], found["completed"], found["stopped_at"]) == (0, True, True, None)
    assert (found["task"], found["seed"], found["message"]) == ("chess", 11, "the program finished")
    assert {*found["referee"]} == {"standing", "on_the_board", "sorted", "heights"}
    assert 5 < found["figures"]["commands_per_second"] < 30
    assert found["figures"]["computer_idle"] > 0.5


def test_without_accelerometers_the_first_motion_trips_a_reflex_and_the_program_stops(
    command: Command,
) -> None:
    words = "sigma chess --pieces 1 --seed 11 --set wrists.left=1 --no-keep --json"
    code, out, _ = command(*words.split())
    found = json.loads(out)
    assert (code, found["assembled"], found["completed"]) == (1, False, False)
    assert [name for name, each in found["referee"].items() if not each["ok"]] == ["sorted", "heights"]
    assert "FORCE" in found["message"]
    assert found["stopped_at"] == "chess.mal"


@pytest.mark.slow
def test_a_kept_board_goes_on_to_the_same_events() -> None:
    whole = begun()
    advance(whole, steps=70)
    second = Runner(whole.checkpoint())
    for each in (whole, second):
        assert finished(each, advance(each), Meter(), judged=True).exit_code == 0
    assert [*map(to_line, second.events)] == [*map(to_line, whole.events)]


@pytest.mark.slow
def test_a_program_that_sorts_wrongly_and_says_that_it_is_done_is_a_silent_failure() -> None:
    runner = begun(mal("chess").replace("IF HEIGHT >", "IF 100 - HEIGHT >"))
    result = finished(runner, advance(runner), Meter(), judged=True)
    assert (result.completed, result.exit_code) == (True, 3)
    assert not result.referee["sorted"].ok
    assert result.referee["heights"].ok


@pytest.mark.slow
def test_a_beam_that_is_stuck_is_not_mistaken_for_a_piece(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(Gantries, "beam", lambda *_: True)
    row = JobWork(setup=job_setup(job_plan("chess", 1), FEW), row=JobRow, settings={})(
        Case(trials=(0,), seed=11)
    )[0]
    assert (row.outcome, "RAIL" in row.detail) == ("stopped", True)


def judged(runner: Runner) -> Findings:
    return CHESS.judge(runner.cell.truth)


@pytest.mark.slow
def test_the_referee_sees_a_fallen_piece_a_wrong_line_and_a_height_that_was_not_told() -> None:
    runner = begun()
    witness = next(m for m in runner.cell.truth.mechanisms if m.name == "heard")
    (piece,) = drawn(GantryWorld(FEW), 1)
    joint = runner.cell.truth.data.joint(piece.name)
    joint.qpos[1] = piece.goal / 1000

    def told(height: float) -> Findings:
        witness.hear(f"HEIGHT {height:.3f}  AT {piece.x + 1}  LINE {piece.line}")  # type: ignore[attr-defined]
        runner.cell.restore(runner.cell.capture())
        return judged(runner)

    runner.cell.restore(runner.cell.capture())
    assert not judged(runner)["heights"].ok
    assert not told(float("nan"))["heights"].ok
    assert all(found.ok for found in told(piece.height - 0.5).values())
    joint.qpos[1] += 0.006
    joint.qpos[3:7] = (np.cos(0.04), np.sin(0.04), 0, 0)
    found = told(piece.height)
    assert [name for name, each in found.items() if not each.ok] == ["standing", "sorted"]
    assert not told(piece.height + 0.7)["heights"].ok  # one of the heights that were told is wrong
    assert not told(piece.height)["heights"].ok


@pytest.mark.sigma_row(29)
@pytest.mark.slow
@pytest.mark.parametrize("seed", [None, 2, 5001, 5003, 5013])
def test_the_height_of_a_block_of_45_mm_is_measured_by_the_beam(seed: int | None) -> None:
    lines = mal("chess").splitlines()
    measuring = [line for line in lines if 190 <= int(line.split()[0]) <= 220]
    text = """10 ORIGIN X1, Y1, Z1
12 BOARD = 180
14 BEAMUP = 2.925
20 MOVE X1 TO 100, Y1 TO 50
30 MOVE Z1 TO 160
"""
    ran = Machine(seed, block="100 50 45").run(text + "\n".join(measuring) + "\n230 PRINT HEIGHT\n")
    assert float(ran.printed[0]) == pytest.approx(45, abs=0.4)


def test_pieces_belong_to_gantries_and_a_plan_keeps_them() -> None:
    plan = job_plan("chess", 4)
    assert decode(encode(plan), "kept") == plan
    assert plan.task == "chess"
    with pytest.raises(BadFile, match="has pieces on its board, so its arm must be `gantries`, not `"):
        decode(encode(MalPlan(name="a.mal", text="10 STOP\n", pieces=2)), "kept")


@pytest.mark.parametrize("words", ["--pieces 0", "--pieces 13", "--video a.gif", "--out a --no-keep"])
def test_a_board_that_cannot_be_is_refused_in_a_sentence(words: str, command: Command) -> None:
    code, _, err = command("sigma", "chess", *words.split())
    assert (code, "Traceback" in err) == (2, False)
