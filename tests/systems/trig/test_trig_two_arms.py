"""A script is typed on the ideal arm, which gives the list of its steps, and in a world, on the arm with physics."""

from pathlib import Path

import pytest
from conftest import Command

from handeye.agents.bench_entrant import verdicts
from handeye.agents.bench_task import bench_task
from handeye.agents.call import Call
from handeye.core.errors import Refused
from handeye.core.variation import WorldSpec
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.systems.trig.jobs.benches import ArmName, TaughtPlan
from handeye.systems.trig.language.no_arm import NoArm
from handeye.systems.trig.session_api import TrigSession

ALOFT = "FREE\nZ 80 RECORD"
HOLD = f"* STACK 1 X -100 Y 0\n{ALOFT}\nFREE\nX -100 RECORD\nFREE\nZ 6 RECORD\nGOGRASP\n{ALOFT}"


def felt(arm: ArmName, hand: str, low: float, table: str) -> tuple[str, float]:
    """What a guarded move to Z `low` meets at X 100, Y 0, and the Z at which it ends (mm)."""
    session = TrigSession(arm)
    session.type(f"FREE\nX 100 Z {low} RECORD\nHERE LOW\n{table}\n{hand}\nFREE\nX 100 RECORD")
    told = session.type("GOGPOS LOW\n2\n(0 0 1)")[-1]
    return told.split()[0], session.hand[2]


@pytest.mark.parametrize("arm", ["none", pytest.param("purbrick", marks=pytest.mark.slow)])
@pytest.mark.parametrize(
    ("hand", "low", "table", "met", "at"),
    [
        (f"{ALOFT}\nGOGRASP", 2, "* STACK 1 X 100 Y 0", "stopped", 12),
        (ALOFT, 2, "* STACK 1 X 100 Y 0", "reached", 2),  # the block is between the open fingers
        (HOLD, 2, "* CLEAR", "stopped", 6),  # the block in the hand meets the table
        (HOLD, 7, "* CLEAR", "reached", 7),
        (HOLD, 8, "* STACK 2 X 100 Y 20", "stopped", 30),  # it meets a part of another block
        (HOLD, 8, "* STACK 2 X 140 Y 0", "reached", 8),
    ],
)
def test_both_arms_feel_what_is_below_the_hand(
    arm: ArmName, hand: str, low: float, table: str, met: str, at: float
) -> None:
    assert felt(arm, hand, low, table) == (met, pytest.approx(at, abs=1.0))


FEELS = """>MA OVER
    X 100 Z 40 RECORD
>GRASP
>MG FEEL
    Z 5 RECORD
    2
    (0 0 1)
>GOPOS OVER
* STACK 1 X 100 Y 0
>RUN 3
>MR RISE
    Z BY 20 RECORD
"""


@pytest.mark.slow
def test_a_script_that_makes_other_steps_in_a_world_is_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(NoArm, "_met", lambda *_: None)  # the branch is now the normal one on the ideal arm
    plan = TaughtPlan(job="arrange", script=FEELS)
    setup = Setup(system="trig", plan=plan, world=WorldSpec(seed=1), camera="auto", judged=False)
    with pytest.raises(
        Refused, match=r"in this world, the script teaches steps that differ .* step 3, `FEEL G`"
    ):
        Runner(Checkpoint(setup=setup))


def test_the_bench_says_line_question_and_arm(tmp_path: Path, command: Command) -> None:
    given = bench_task("tower").given()["solution.trig"].decode()
    script = given.replace("; Teach the program here.", ">MA A\n    Z 80 RECORD\n>M A\n>GRASP")
    (tmp_path / "solution.trig").write_text(script)
    line = script.splitlines().index(">GRASP") + 1
    said = (
        f"solution.trig, line {line}: TRIG asks “Move to the predefined location?”, but `GRASP` is not an answer; "
        "type Yes or No (typed on the ideal arm)"
    )
    found = verdicts(bench_task("tower"), tmp_path, [0, 1], Call())
    assert [each.message for each in found] == [said, said]
    code, out, _ = command("bench", "agents", "tower", "--try", str(tmp_path), "--feedback", "trace")
    assert (code, out.count(said), "```" in out) == (0, 4, False)
    assert f"## No steps (seed 0, 1, 2)\n\nThe program did not make a step: {said}\n" in out


def test_a_pipe_prints_each_question_with_its_answer(command: Command) -> None:
    typed = "M A\nX 20 RECORD\nM A\nGRASP\nM A\nYes\nMG B"
    assert command("trig", typed=typed)[1] == (
        "Move to the predefined location? GRASP\nline 4: `GRASP` is not an answer; type Yes or No\n"
        "Move to the predefined location? Yes\ncancelled\n"
    )


@pytest.mark.slow
def test_a_script_is_shown_as_an_arm_has_made_it(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(NoArm, "_met", lambda *_: None)
    Path("feels.trig").write_text(FEELS, encoding="utf-8")
    assert "g ***" not in command("trig", "show", "feels.trig")[1]
    assert "g ***" in command("trig", "show", "feels.trig", "--arm", "purbrick")[1]
