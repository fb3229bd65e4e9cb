"""The stages that the walk in docs/stepping.md lists; `execution/test_whole_run.py` takes its steps."""

from stepping_walk import of_command, pieces

from handeye.core.resources import plans
from handeye.debugger.listing import listing_text
from handeye.planfile.store import read_plan


def test_the_stages_of_the_walk_are_those_of_the_plan() -> None:
    plan = read_plan(plans() / "water_pump.plan.json")
    listed = "\n".join(listing_text(plan.program))
    shown = pieces(of_command("stages plans/water_pump.plan.json"))
    assert shown
    assert all("\n".join(piece) in listed for piece in shown)
