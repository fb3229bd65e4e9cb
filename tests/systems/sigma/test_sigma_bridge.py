"""The bridge from MAL to a plan, and the Stanford arm in place of the machine."""

import json
import re
from collections.abc import Callable
from math import pi
from pathlib import Path
from typing import Final

import pytest
from mal_bench import ROOT, carried_out, mal

from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import Refused
from handeye.core.source import Source
from handeye.planfile.store import read_plan
from handeye.planning.planner import plan_program
from handeye.program.flow_operations import Jump, Test, Wait
from handeye.program.guards import Against
from handeye.program.motion_operations import Change, Close, Move, Open
from handeye.program.program import Program
from handeye.program.taught import Taught
from handeye.systems.sigma.bridge.borrowed_run import SAID, BorrowedRun, lines, run_borrowed
from handeye.systems.sigma.bridge.language import bridge
from handeye.systems.sigma.bridge.translation import AT, translated
from handeye.systems.sigma.machine.perfect import PerfectMotors
from handeye.systems.sigma.mal.compiler import program_of
from handeye.systems.sigma.protocol import STEP_MM

Command = Callable[..., tuple[int, str, str]]
PRESS: Final = """10 ORIGIN X1, Y1, Z1
20 ACTUATE HAND1 = 0
30 MOVE X1 TO 200, Y1 TO 150
40 MOVE Z1 TO 100 SLOW 20
50 ACTUATE HAND1
60 MOVE Z1 BY 60 SLOW 10
70 IF ABS(FORCE(Z1)) > 8 THEN 100
80 MOVE X1 TO 210, Y1 TO 150, Z1 TO 100
90 GOTO 60
100 LIMIT Z1, 20
110 MOVE Z1 BY - 40
120 END
"""


def made(text: str) -> Program:
    program, found = translated(Source(name="press.mal", text=text), Taught())
    assert program is not None, found
    return program


def refused(text: str) -> list[str]:
    program, found = translated(Source(name="press.mal", text=text), Taught())
    assert program is None
    return [each.message for each in found]


def test_moves_become_motions_and_a_force_test_becomes_the_guard_of_the_motion_before() -> None:
    program = made(PRESS)
    origin, opened, across, down, closed, pressed, test, back, again, _, up, tested, stopped, _ = (
        step.operation for step in program.steps
    )
    assert isinstance(origin, Move)
    assert program.positions[origin.goal].at == pytest.approx((0.35, 0.55, 0.18, pi / 2, pi / 2, 0))
    assert (opened, closed) == (Open(gap=0.044), Close())
    assert isinstance(across, Move)
    assert program.positions[across.goal].at[:3] == pytest.approx((0.55, 0.7, 0.18))
    assert (across.direct, across.guards) == (True, ())
    assert down == Change(displacement=(0.0, 0.0, -0.1), speed=0.02)
    assert pressed == Change(displacement=(0.0, 0.0, -0.06), speed=0.01, guards=(Against(force=8.0),))
    names = {number: program.steps[number].labels[0] for number in range(14) if program.steps[number].labels}
    assert isinstance(test, Test)
    assert (names[test.raised or 0], names[program.steps[6].next or 0]) == ("80", "100")  # not met; met
    assert isinstance(back, Move)
    assert (isinstance(again, Jump), names[program.steps[8].next or 0]) == (True, "60")
    assert up == Change(displacement=(0.0, 0.0, 0.04), guards=(Against(force=20.0),))
    assert (isinstance(tested, Test), program.steps[11].next) == (True, 12)
    assert stopped == Wait(message="ABORT Z1 FORCE: line 110")


def test_a_limit_with_on_abort_leads_to_its_line_and_arm_2_is_mirrored() -> None:
    text = "10 ORIGIN X2, Y2, Z2\n20 ON ABORT GOTO 60\n30 LIMIT X2, 9\n40 MOVE X2 TO 100\n50 END\n60 MOVE X2 BY -5\n"
    program = made(text)
    motion, test = program.steps[3].operation, program.steps[4].operation
    assert motion == Change(displacement=(-0.1, 0.0, 0.0), guards=(Against(force=9.0),))
    assert isinstance(test, Test)
    assert (program.steps[test.raised or 0].labels, program.steps[program.steps[4].next or 0].labels) == (
        ("50",),
        ("60",),
    )


def test_the_straight_motions_add_up_to_where_the_perfect_motors_are() -> None:
    text = "10 ORIGIN X1, Y1, Z1\n20 MOVE X1 TO 120\n30 MOVE Y1 BY 30, X1 BY - 15 LINE\n40 MOVE Z1 TO 42 SLOW 8\n"
    ways = [step.operation for step in made(text).steps if isinstance(step.operation, Change)]
    x, y, z = (sum(axis) * 1000 for axis in zip(*(way.displacement for way in ways), strict=True))
    counts = carried_out(text).vm.memory.counts
    assert (x, y, -z) == pytest.approx([counts[axis] * STEP_MM for axis in ("X1", "Y1", "Z1")], abs=STEP_MM)


@pytest.mark.sigma_row(53)
@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("FOR I = 1 TO 3", "there is no operation for FOR"),
        ("HIGH = 4", "there is no operation for LET"),
        ('PRINT "X"', "there is no operation for PRINT"),
        ("DELAY 1", "there is no operation for DELAY"),
        ("START LEFT", "a plan can have only one task"),
        ("TAKE FREE", "a plan can have only one task, and no flags"),
        ("CURVE X1, 2", "the planner chooses how the arm accelerates"),
        ("MOVE X1 TO 20 + 5", "one of its values is calculated during the run"),
        ("MOVE X1 TO 700", "the rail of X goes from 0 to 600 mm, not to 700"),
        ("MOVE X1 TO 20 NOWAIT", "with NOWAIT, the program would go on before the arm has arrived"),
        ("MOVE X1 TO 20, Y1 TO 9 SLOW 5", "with SLOW, the path of several axes is not straight"),
        ("MOVE X2 TO 20", "it uses arm 2, but line 10 uses arm 1"),
        ("ACTUATE BELL", "the arm has no BELL"),
        ("ORIGIN X1", "ORIGIN is a single motion of the arm: name all three axes"),
        ("IF BEAM(1) = 1 THEN 10", "an IF can only compare ABS(FORCE(axis)) with a number"),
        ("IF ABS(FORCE(X1)) > 3 THEN 10", "a test of FORCE must directly follow a MOVE of only this axis"),
    ],
)
def test_a_line_that_cannot_become_a_motion_is_refused_by_its_number(line: str, why: str) -> None:
    text = f"10 ORIGIN X1, Y1, Z1\n20 {line}\n30 GOTO 10\n"
    if "FOR" in line and "FORCE" not in line:
        text = text.replace("30 GOTO", "30 NEXT I\n40 GOTO")
    text += "90 TASK LEFT\n95 END\n" if "LEFT" in line else ""
    text += "35 SET FREE\n" if "FREE" in line else ""
    assert any(told.startswith(f"line 20 cannot become a motion of a plan: {why}") for told in refused(text))


def test_a_place_that_depends_on_the_way_is_refused_and_so_is_one_out_of_reach() -> None:
    free = PRESS.replace("80 MOVE X1 TO 210, Y1 TO 150, Z1 TO 100", "80 MOVE Z1 TO 90")
    assert made(free)  # if the force is not met, the place is known
    (told,) = refused(PRESS.replace("110 MOVE Z1 BY - 40", "110 MOVE Z1 TO 90"))
    assert told.startswith("line 110 cannot become a motion of a plan: the place of X1 is not known here")
    (told,) = refused("10 MOVE X1 TO 20\n")
    assert "the place of Y1 and Z1 is not known here" in told
    (told,) = refused("10 ORIGIN X1, Y1, Z1\n20 MOVE X1 BY 5\n30 LIMIT X1, 9\n40 GOTO 20\n")
    assert (
        "the LIMIT or the SPEED of an axis that this line moves depends on how the program reached this line"
        in told
    )
    far = bridge((3000.0, 0.0))
    program, _ = far.compile(Source(name="press.mal", text=PRESS), Taught())
    assert program is not None
    _, found = plan_program(program, STANFORD, far)
    assert re.search(r"the Stanford arm cannot make the motion of line \d+: ", found[0].message)


def test_the_command_writes_a_plan_and_says_that_there_is_no_bus(command: Command, tmp_path: Path) -> None:
    file = tmp_path / "press.mal"
    file.write_text(PRESS, encoding="utf-8")
    code, out, _ = command("sigma", "bridge", str(file))
    assert (code, "no bus" in out) == (0, True)
    plan = read_plan(tmp_path / "press.plan.json")
    assert (plan.program.language, plan.arm, len(plan.motions)) == ("mal", "Stanford", 6)
    file.write_text(mal("handover"), encoding="utf-8")
    code, _, err = command("sigma", "bridge", str(file))
    assert (code, "line 40 cannot become a motion" in err, "Traceback" in err) == (2, True, False)
    assert err.count("tests of FORCE right after a MOVE") == 1
    assert command("sigma", "bridge", str(tmp_path / "none.mal"))[0] == 2
    assert AT == (350.0, 550.0)


TOUCH: Final = """10 ORIGIN X1, Y1, Z1
20 MOVE X1 TO 250, Y1 TO 100, Z1 TO 150
30 LIMIT Z1, 12
40 ON ABORT Z1 GOTO 70
50 MOVE Z1 BY 45 SLOW 10
60 END
70 PRINT "TABLE", POS(Z1), "FORCE", FORCE(Z1)
"""


@pytest.mark.sigma_row(54)
@pytest.mark.slow
def test_the_stanford_arm_finds_the_table_under_the_board_and_the_run_says_that_there_is_no_bus(
    command: Command, tmp_path: Path
) -> None:
    file = tmp_path / "touch.mal"
    file.write_text(TOUCH, encoding="utf-8")
    code, out, err = command("sigma", "borrow", str(file), "--json")
    found = json.loads(out)
    assert (code, found["completed"], found["figures"]["bus"]) == (0, True, False)
    assert "There is no bus" in err
    said = re.search(r"TABLE +(\S+) +FORCE +(\S+)", err)
    assert said is not None
    assert float(said[1]) == pytest.approx(180, abs=1)  # the board of SUPERSIGMA is 180 mm under Z1 = 0
    assert -14 < float(said[2]) < -12
    assert found["figures"]["error_mm"] < 2  # while it presses
    shown = [*err.splitlines()[:2], *lines(BorrowedRun(**found["figures"]))]
    assert "\n".join(shown) in (ROOT / "docs/other_arm.md").read_text(encoding="utf-8")


@pytest.mark.sigma_row(54)
@pytest.mark.parametrize(
    ("line", "why"),
    [
        ("MOVE X2 TO 5", "uses X2"),
        ("ACTUATE DRIVER2", "uses DRIVER2"),
        ("LIMIT Z2, 5", "uses Z2"),
        ("A = BEAM(1)", "asks for a light beam"),
        ("IF FORCE(Z2) > 3 THEN 10", "uses Z2"),
        ("IF 1 = 1 THEN MOVE Y2 BY 3", "uses Y2"),
    ],
)
def test_what_the_stanford_arm_lacks_is_refused_by_line(
    line: str, why: str, command: Command, tmp_path: Path
) -> None:
    file = tmp_path / "lacks.mal"
    file.write_text(f"10 ORIGIN X1\n20 {line}\n", encoding="utf-8")
    code, _, err = command("sigma", "borrow", str(file))
    assert (code, f"line 20 {why}; the Stanford arm replaces only arm 1" in err) == (2, True)


@pytest.mark.parametrize("job", ["bridge", "borrow"])
@pytest.mark.parametrize("at", ["nan", "inf", "1e300"])
def test_a_board_that_lies_nowhere_is_refused(job: str, at: str, command: Command, tmp_path: Path) -> None:
    file = tmp_path / "touch.mal"
    file.write_text(TOUCH, encoding="utf-8")
    code, _, err = command("sigma", job, str(file), "--at", "350", at)
    assert (code, "--at must be between -10000 and 10000 mm" in err) == (2, True)


class Lame(PerfectMotors):
    """Cannot move beyond 100 mm."""

    most, error = 0.0, 0.0

    def wait(self, until: int) -> int:
        far = any((motor.place + motor.steps) * STEP_MM > 100 for motor in self._memory.motors.values())
        if far and until > self.now + 9000:  # not while the computer works
            raise Refused("the arm does not reach X1 = 300 mm")
        return super().wait(until)


def test_a_motion_that_the_borrowed_arm_cannot_make_stops_the_program_at_its_line() -> None:
    program = program_of("far.mal", "10 ORIGIN X1\n20 MOVE X1 TO 90\n30 MOVE X1 TO 300\n40 MOVE X1 TO 20\n")
    found = run_borrowed(program, Lame())  # type: ignore[arg-type]
    assert (found.completed, found.message) == (
        False,
        "the task MAIN, line 30: the arm does not reach X1 = 300 mm",
    )


def test_the_programs_of_the_page_are_those_of_the_tests() -> None:
    page = (ROOT / "docs/other_arm.md").read_text(encoding="utf-8")
    press, touch = re.findall(r"```mal \S+\n(.*?)```", page, flags=re.DOTALL)
    assert len([step for step in made(press).steps if isinstance(step.operation, Test)]) == 1
    assert touch == TOUCH
    assert " ".join(SAID.split()) in " ".join(page.split())
