"""What tests keep of long programs' plans is what they would otherwise plan again."""

from pathlib import Path

from kept_plans import keeping
from short_runs import FEEL, GRASP, plan_of

from handeye.arm.model import ArmModel
from handeye.arm.robots.stanford import STANFORD
from handeye.planfile.plan import Plan
from handeye.planfile.store import encode
from handeye.planning import planner
from handeye.program.diagnosis.plan_findings import PlanFinding
from handeye.program.program import Program

make_plan = planner.make_plan.__wrapped__


def test_a_kept_plan_is_that_which_is_made_again_whatever_others_do_to_theirs(tmp_path: Path) -> None:
    program, kept = plan_of(GRASP).program, keeping(make_plan, tmp_path, 0)
    made, findings = make_plan(program, STANFORD, task="water_pump")
    assert (made is None, findings) == (False, [])
    for _ in range(3):
        plan, findings = kept(program, STANFORD, task="water_pump")
        assert (plan, findings) == (made, [])
        assert encode(plan) == encode(made)
        plan.motions.clear()


def test_what_differs_in_anything_is_planned_for_itself(tmp_path: Path) -> None:
    feel, grasp = plan_of(FEEL), plan_of(GRASP)
    made: list[object] = []

    def noted(
        program: Program, arm: ArmModel, *, task: str, **_: object
    ) -> tuple[Plan | None, list[PlanFinding]]:
        made.append(task)
        return None if task == "none" else grasp, []

    kept = keeping(noted, tmp_path, len(grasp.program.steps))
    asked = [(grasp.program, "pump", 0.4), (grasp.program, "block", 0.4), (grasp.program, "pump", 0.5)]
    for program, task, speed in (*asked, *asked):
        assert kept(program, STANFORD, task=task, speed=speed) == (grasp, [])
    assert made == ["pump", "block", "pump"]
    assert len(feel.program.steps) < len(grasp.program.steps)
    for program, task in [(feel.program, "short")] * 2 + [(grasp.program, "none")] * 2:
        kept(program, STANFORD, task=task)
    assert made == ["pump", "block", "pump", "short", "short", "none", "none"]
