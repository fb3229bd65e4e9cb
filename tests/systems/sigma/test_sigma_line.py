"""The assembly line: two SUPERSIGMAs, a feeder and a belt on one bus; referee, planted mistakes, commands."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Final

import numpy as np
import pytest
from mal_bench import PLANS, Ran, go_on, mal
from msgspec.structs import replace

from handeye.core.errors import BadArgument, BadFile
from handeye.core.variation import WorldSpec
from handeye.judge.finding import Findings
from handeye.program.events import SystemEvent
from handeye.runs.advance import advance
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.sigma.bus.layout import LINE as LAYOUT
from handeye.systems.sigma.bus.plant import TRAVEL, IdealMachine
from handeye.systems.sigma.bus.wired import WiredBus
from handeye.systems.sigma.gantries.witness import HEARD
from handeye.systems.sigma.gantries.world import GantryWorld
from handeye.systems.sigma.line.pieces import MOST, PIN, PINS, drawn, pin
from handeye.systems.sigma.line.scene import TOP
from handeye.systems.sigma.line.task import LINE
from handeye.systems.sigma.line.witness import LineWitness
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.mal.interleavings import Interleavings, interleavings
from handeye.systems.sigma.mal.virtual_machine import VirtualMachine
from handeye.systems.sigma.protocol import LINE_AXES, LINE_NUMBERS
from handeye.systems.sigma.run.jobs import job_plan, job_setup

Command = Callable[..., tuple[int, str, str]]
WORLD: Final = WorldSpec(seed=5)
TEXT: Final = mal("line")
HALF: Final = ("BRINGER2", "PRESSER2")  # the tasks of the second SUPERSIGMA
BETWEEN: Final = ("TAKE MAYTAKE", "SET TAKEN", "TAKE MAYPUT", "SET PUT")  # them and the belt


def begun(pieces: int = 1) -> Runner:
    """A line before the first statement."""
    return Runner(Checkpoint(setup=job_setup(job_plan("line", pieces), WORLD)))


def judged(runner: Runner) -> Findings:
    return LINE.judge(runner.cell.truth)


def wrong(findings: Findings) -> list[str]:
    return [name for name, found in findings.items() if not found.ok]


def half(*without: str) -> str:
    """The program of the second SUPERSIGMA alone, for two pieces, which the belt brings at once."""
    lines, kept = list[str](), True
    for line in TEXT.splitlines():
        number, words = line.split(" ", 1)
        if words.startswith("TASK "):
            kept = words.split()[1] in HALF
        if words.startswith("START "):
            words = f"START {', '.join(HALF)}"
        if words.startswith("WAIT "):
            words = f"WAIT {' AND '.join(f'{name}DONE' for name in HALF)}"
        if words in (*BETWEEN, *without) or words.startswith("PRINT "):
            words = "REM"
        if kept:
            lines.append(f"{number} {words}")
    return "\n".join(lines).replace("= SLOT3", "= 1").replace("0 TO 8", "0 TO 1").replace("BY 0.15", "BY 6")


def without_physics(text: str) -> Ran:
    """A program carried out by the 26 microcomputers, with pieces in all beams and no forces."""
    machine = IdealMachine()
    machine.memory.starts = {LINE_NUMBERS[axis]: TRAVEL[axis[0]] // 4 for axis in LINE_AXES}
    machine.memory.lengths = {LINE_NUMBERS[axis]: TRAVEL[axis[0]] for axis in LINE_AXES}
    machine.memory.cut = {LINE_NUMBERS[hand]: True for hand in ("HAND5", "HAND6")}
    events: list[SystemEvent] = []
    vm = VirtualMachine(
        program_of("line.mal", text, line=True), WiredBus(LAYOUT, plant=machine), events.append
    )
    vm.begin()
    return go_on(Ran(vm, events))


def test_the_names_of_the_line_are_those_of_26_microcomputers_on_three_segments() -> None:
    kinds = {"F": "force", "H": "hand", "S": "sensor"}
    assert {place.number: place.kind for place in LAYOUT.places} == {
        number: kinds.get(name[0], "motor") for name, number in LINE_NUMBERS.items()
    }
    assert [len(numbers) for numbers in LAYOUT.segments] == [10, 10, 6]


def test_pieces_are_drawn_in_the_cells_of_the_tray() -> None:
    pieces = drawn(GantryWorld(WORLD), MOST)
    assert [round((65 - p.x) / 60) + 2 * round((215 - p.y) / 60) for p in pieces] == [0, 1, 2, 3]
    assert [piece.goal[0] for piece in pieces] == [1430, 1360, 1290, 1220]
    with pytest.raises(BadArgument, match="the feeder must have 1 to 4 pieces, not 5"):
        drawn(GantryWorld(), 5)


@pytest.mark.sigma_row(48)
@pytest.mark.slow
def test_a_feeder_that_stops_after_one_piece_halts_the_others_and_the_piece_is_counted(
    command: Command,
) -> None:
    code, out, _ = command("sigma", "line", *["--pieces", "1", "--seed", "5", "--no-keep", "--json"])
    found = json.loads(out)
    assert (code, found["assembled"], found["message"]) == (0, True, "the program finished")
    assert {*found["referee"]} == {"standing", "on_the_belt", "withdrawn", "pressed", "counted", "apart"}


@pytest.mark.sigma_row(48)
@pytest.mark.slow
def test_26_microcomputers_work_for_seven_tasks_and_a_flag_that_is_not_set_is_a_deadlock_with_a_name() -> (
    None
):
    ran = without_physics(TEXT)
    assert (ran.vm.memory.fault, ran.printed[0].split()[:4]) == (None, ["PIECES", "0", "WITHDRAWN", "9"])
    stuck = without_physics(TEXT.replace("625 SET PLACE1FREE\n", "")).vm.memory.fault
    assert stuck is not None
    assert stuck.told.startswith("DEADLOCK")
    assert "the task BRINGER1, line 400, waits for flag PLACE1FREE" in stuck.told


@pytest.mark.sigma_row(48)
@pytest.mark.slow
def test_no_order_of_its_tasks_is_a_race_or_a_deadlock_in_the_second_half_of_the_line() -> None:
    def tried(text: str, most: int) -> Interleavings:
        return interleavings(program_of("half.mal", text, line=True), most)

    result = tried(half(), 5_000)
    assert (result.complete, result.findings, result.unreached) == (True, (), ())
    (hands, *_) = (each for each in tried(half("TAKE PLACE2FREE"), 1_500).findings if each.kind == "hands")
    assert hands.lines == (875, 1065)
    assert "deadlock" in {each.kind for each in tried(half("SET PLACE2FREE"), 1_500).findings}


@pytest.mark.slow
def test_a_kept_line_goes_on_to_the_same_events() -> None:
    whole = begun()
    advance(whole, steps=40)
    second = Runner(whole.checkpoint())
    for each in (whole, second):
        advance(each, steps=20)
    assert second.events == whole.events


@pytest.mark.slow
def test_the_referee_sees_what_is_wrong_with_a_piece_and_with_each_count() -> None:
    runner = begun()
    witness = next(m for m in runner.cell.truth.mechanisms if m.name == HEARD)
    assert isinstance(witness, LineWitness)
    (piece,) = drawn(GantryWorld(WORLD), 1)
    data = runner.cell.truth.data
    joint, pins = data.joint(piece.name), [data.joint(pin(piece.name, which)) for which in PINS]

    def found() -> list[str]:
        runner.cell.restore(runner.cell.capture())
        return wrong(judged(runner))

    assert found() == ["withdrawn", "pressed"]
    joint.qpos[:3] = piece.goal[0] / 1000, piece.goal[1] / 1000, TOP
    pins[0].qpos[0] = PIN / 1000
    assert found() == ["pressed"]
    pins[1].qpos[0] = PIN / 1000
    assert found() == ["counted"]
    witness.hear("PIECES        1             WITHDRAWN     0             SECONDS       48")
    assert found() == ["counted"]
    witness.hear("PIECES        1             WITHDRAWN     1             SECONDS       48")
    assert found() == []
    joint.qpos[3:7] = (np.cos(0.04), np.sin(0.04), 0, 0)
    assert found() == ["standing", "counted"]
    with pytest.raises(BadFile, match="touched"):
        witness.check(replace(witness.state(), touched_ms=-1))


def test_supersigma_alone_refuses_a_program_for_the_line(command: Command, tmp_path: Path) -> None:
    for words in (["run", str(PLANS / "line.mal")], ["bus", "run", str(PLANS / "line.mal")]):
        code, _, err = command("sigma", *words)
        assert (
            code,
            "line 110 of line.mal uses an axis or a hand that only the assembly line has" in err,
        ) == (
            2,
            True,
        )
    file = tmp_path / "own.mal"
    file.write_text('10 PRINT "PIECES", 0, "WITHDRAWN", 0\n', encoding="utf-8")
    assert command("sigma", "line", str(file), *["--pieces", "1", "--no-keep"])[0] == 3


@pytest.mark.parametrize("words", ["nowhere.mal", "--pieces 0", "--pieces 5", "--video a.gif"])
def test_a_line_that_cannot_be_is_refused_in_a_sentence(words: str, command: Command) -> None:
    code, _, err = command("sigma", "line", *words.split())
    assert (code, "Traceback" in err) == (2, False)
