"""The insertion: pegs squared in the rack, holes found by force; the referee, planted mistakes, commands."""

import json
from collections.abc import Callable
from math import atan2, cos, degrees, radians, sin
from pathlib import Path
from typing import Final

import numpy as np
import pytest
from gantry_bench import Machine
from mal_bench import mal
from msgspec.structs import replace

from handeye.core.errors import BadArgument, BadFile
from handeye.core.variation import WorldSpec
from handeye.judge.finding import Findings
from handeye.results.finishing import finished
from handeye.results.result import Result
from handeye.runs.advance import advance
from handeye.runs.host_seconds import Meter
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.sigma.gantries.witness import HEARD
from handeye.systems.sigma.gantries.world import GantryWorld
from handeye.systems.sigma.insert.pieces import HIGH, MOST, OFF, TURNED, drawn
from handeye.systems.sigma.insert.task import INSERTION
from handeye.systems.sigma.insert.witness import InsertionWitness
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.mal.interleavings import interleavings
from handeye.systems.sigma.protocol import NUMBERS
from handeye.systems.sigma.run.jobs import job_plan, job_setup

Command = Callable[..., tuple[int, str, str]]
WORLD: Final = WorldSpec(seed=3)
TEXT: Final = mal("insert").replace(" = 1 TO 2\n", " = 1 TO 1\n")
ONE: Final = TEXT.replace("LEFT, RIGHT", "LEFT").replace("LEFTDONE AND RIGHTDONE", "LEFTDONE")


def begun(text: str = ONE, pegs: int = 1) -> Runner:
    """A board before the first statement."""
    plan = replace(job_plan("insert", pegs), text=text)
    return Runner(Checkpoint(setup=job_setup(plan, WORLD)))


def ended(runner: Runner) -> Result:
    return finished(runner, advance(runner), Meter(), judged=True)


def wrong(findings: Findings) -> list[str]:
    return [name for name, found in findings.items() if not found.ok]


def judged(runner: Runner) -> Findings:
    return INSERTION.judge(runner.cell.truth)


def test_pegs_are_drawn_turned_and_plates_up_to_3_mm_beside_their_places() -> None:
    pegs = [peg for seed in range(40) for peg in drawn(GantryWorld(WorldSpec(seed=seed)), MOST)]
    off = [
        np.hypot(p.plate_x - 100 - 400 * (n % 2), p.plate_y - 100 - 180 * (n % 4 // 2))
        for n, p in enumerate(pegs)
    ]
    assert 0.9 * OFF < max(off) <= OFF + 0.01
    assert 0.9 * TURNED < max(abs(peg.turned) for peg in pegs) <= TURNED
    with pytest.raises(BadArgument, match="an insertion must have 1 to 4 pegs, not 5"):
        drawn(GantryWorld(), 5)


@pytest.mark.sigma_row(47)
@pytest.mark.slow
@pytest.mark.parametrize("turned", [-TURNED, TURNED])
def test_two_pushes_against_a_corner_square_a_peg(turned: float) -> None:
    text = ONE[: ONE.index("REM THE FINGERS CLOSE A LITTLE")].rsplit("\n", 1)[0] + "\n"
    runner = begun("\n".join(line for line in text.splitlines() if "GOSUB 3" not in line) + "\n295 STOP\n")
    body, joint = runner.cell.truth.data.body("peg_1"), runner.cell.truth.data.joint("peg_1")
    joint.qpos[3:7] = cos(radians(turned) / 2), 0, 0, sin(radians(turned) / 2)
    runner.cell.restore(runner.cell.capture())
    advance(runner)
    across = body.xmat.reshape(3, 3)
    assert abs(degrees(atan2(across[1, 0], across[0, 0]))) < 2
    assert (body.xpos[:2] * 1000).tolist() == pytest.approx([300, 60], abs=0.5)


@pytest.mark.slow
def test_a_program_that_counts_a_peg_on_top_of_its_plate_fails_in_silence() -> None:
    never = (
        ONE.replace("> 3 THEN", "> 300 THEN").replace("< 3 THEN", "< 300 THEN").replace("BY 0.6", "BY 0.1")
    )
    runner = begun(never.replace("MOVE Z1 TO BOARD - GRIP - 1.2 SLOW 30", "REM"))
    result = ended(runner)
    assert (result.exit_code, {"at_depth", "counted"} <= {*wrong(judged(runner))}) == (3, True)


@pytest.mark.slow
def test_at_the_rack_no_order_of_the_tasks_is_a_deadlock_or_a_race() -> None:
    text = TEXT.replace("0.15", "6").replace("20 ORIGIN X1, Y1, Z1, X2, Y2, Z2\n", "")  # few states
    for number, task, arm in ((100, "LEFT", 1), (500, "RIGHT", 2)):
        begin = f"{number} TASK {task}\n"
        text = text.replace(begin, f"{begin}{number + 1} ORIGIN X{arm}, Y{arm}, Z{arm}\n")
    result = interleavings(program_of("test.mal", text), 50_000)  # beams read 0, so no peg is carried away
    assert (result.complete, result.findings) == (True, ())
    shared = "\n".join(line for line in text.splitlines() if "TAKE" not in line)
    assert "hands" in {each.kind for each in interleavings(program_of("test.mal", shared), 500).findings}


def test_the_referee_sees_a_peg_beside_its_hole_a_moved_plate_and_what_wrists_and_motors_bore() -> None:
    runner = begun()
    witness = next(m for m in runner.cell.truth.mechanisms if m.name == HEARD)
    assert isinstance(witness, InsertionWitness)
    (peg,) = drawn(GantryWorld(WORLD), 1)
    data = runner.cell.truth.data
    joint, plate = data.joint(peg.name), data.joint(peg.plate)

    def found() -> list[str]:
        runner.cell.restore(runner.cell.capture())
        return wrong(judged(runner))

    assert found() == ["in_the_hole"]
    joint.qpos[:3] = peg.plate_x / 1000, peg.plate_y / 1000, HIGH / 2000
    assert found() == ["counted"]
    witness.hear("PEGS          1             TRIES         5")
    assert found() == []
    plate.qpos[0] += 0.0012
    joint.qpos[0] += 0.0012
    assert found() == ["plates"]
    plate.qpos[0] -= 0.0012
    assert found() == ["in_the_hole", "counted"]
    joint.qpos[0] -= 0.0012
    joint.qpos[2] += 0.0011
    assert found() == ["at_depth", "counted"]
    joint.qpos[2] -= 0.0011
    witness.restore(replace(witness.state(), most_n=25.1, lost=1, touched_ms=3))
    assert found() == ["force", "steps", "apart"]
    for state in (replace(witness.state(), touched_ms=-1), replace(witness.state(), slipped=(0,))):
        with pytest.raises(BadFile):
            witness.check(state)


def test_a_force_that_reverses_within_a_step_is_released_with_hysteresis() -> None:
    machine = Machine()
    hand = machine.gantries.bench.model.body("hand_1").id
    pressed = []
    for newtons in (6.0, -3.9, 0.0):
        machine.gantries.bench.data.xfrc_applied[hand, 0] = newtons
        machine.rest(0.001)
        pressed.append(machine.bus.motor(NUMBERS["X1"]).memory.force)
    machine.rest(0.005)
    assert (pressed[:2], machine.bus.motor(NUMBERS["X1"]).memory.force) == ([True, True], False)


def test_the_result_of_a_users_own_program_has_the_fields_of_an_assembly(
    command: Command, tmp_path: Path
) -> None:
    file = tmp_path / "own.mal"
    file.write_text('10 PRINT "PEGS", 0\n', encoding="utf-8")
    code, out, _ = command("sigma", "insert", str(file), *["--seed", "3", "--no-keep", "--json"])
    found = json.loads(out)
    assert (code, found["assembled"], found["completed"], found["task"]) == (3, False, True, "insert")
    assert [name for name, each in found["referee"].items() if not each["ok"]] == ["in_the_hole"]
    assert found["figures"]["simulated_s"] >= 0


def test_an_object_in_the_closed_fingers_cuts_the_beam() -> None:
    lines = (
        "ORIGIN X1, Y1, Z1", "MOVE X1 TO 100, Y1 TO 50", "MOVE Z1 TO 160", "ACTUATE HAND1 = 1", "PRINT BEAM(1)",
        "ACTUATE HAND1 = 0", "MOVE Z1 TO 100", "ACTUATE HAND1 = 1", "PRINT BEAM(1)",
    )  # fmt: skip
    text = "".join(f"{10 * number} {line}\n" for number, line in enumerate(lines, 1))
    assert Machine(block="100 50 45").run(text).printed == ["1", "0"]


@pytest.mark.parametrize("words", ["nowhere.mal", "--pegs 0", "--pegs 5", "--video a.gif"])
def test_an_insertion_that_cannot_be_is_refused_in_a_sentence(words: str, command: Command) -> None:
    code, _, err = command("sigma", "insert", *words.split())
    assert (code, "Traceback" in err) == (2, False)
