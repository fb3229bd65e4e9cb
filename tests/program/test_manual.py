"""docs/plan.md shows what the commands say."""

import re
from pathlib import Path

import pytest
from conftest import Command

from handeye.core.resources import plans
from handeye.inspection.drawing import flow_svg
from handeye.inspection.flow import flow
from handeye.planfile.store import read_plan

DOCS = Path(__file__).parents[2] / "docs"
PUMP = plans() / "water_pump.plan.json"
SHOWN = re.findall(
    r"^```console\n\$ handeye (\w+) [^\n]*\n(.*?)^```$",
    (DOCS / "plan.md").read_text(encoding="utf-8"),
    re.M | re.S,
)
"""Commands of the manual and what they print."""


def shown(word: str) -> str:
    (output,) = (said for command, said in SHOWN if command == word and said)
    return output


def test_the_listing_in_the_manual_is_what_inspect_prints(command: Command) -> None:
    assert command("inspect", str(PUMP), "--stage", "feel for the grasp") == (0, shown("inspect"), "")


@pytest.mark.slow
def test_the_difference_in_the_manual_is_what_diff_prints(command: Command) -> None:
    script = (plans() / "water_pump.al").read_text(encoding="utf-8").replace("[0 0 -60]", "[0 0 -70]")
    lines = script.splitlines()
    after = next(number for number, line in enumerate(lines) if line.split() == ["SAVE", "E1"])
    assert lines.pop(after + 1).split() == ["OPEN", ".5"]
    taught = (plans() / "water_pump.toml").read_text(encoding="utf-8")
    Path("changed.al").write_text("\n".join(lines), encoding="utf-8")
    Path("changed.toml").write_text(
        taught.replace("T2 = { at = [2.98811", "T2 = { at = [3.23811"), encoding="utf-8"
    )
    assert command("plan", "changed.al")[0] == 0
    assert command("diff", str(PUMP), "changed.plan.json") == (1, shown("diff"), "")


def test_the_drawing_in_the_manual_is_the_one_that_inspect_makes() -> None:
    drawn = (DOCS / "pictures/pins.svg").read_text(encoding="utf-8")
    assert drawn == flow_svg(flow(read_plan(PUMP), 4)), (
        "draw it again: handeye inspect plans/water_pump.plan.json --stage 4 --graph svg -o docs/pictures/pins.svg"
    )
