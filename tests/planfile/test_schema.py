"""The schema says what the types say, and a plan of another version of the format is refused."""

import json

import pytest

from handeye.core.errors import InvalidInput
from handeye.core.resources import plans
from handeye.planfile.plan import VERSION
from handeye.planfile.schema import plan_schema
from handeye.planfile.store import decode

PUMP = plans() / "water_pump.plan.json"


@pytest.mark.parametrize("version", [VERSION - 1, VERSION + 1])
def test_a_plan_of_another_version_is_refused_and_the_cure_is_told(version: int) -> None:
    text = PUMP.read_text(encoding="utf-8").replace(f'"version": {VERSION}', f'"version": {version}', 1)
    said = (
        f"^old\\.json has plan format version {version}; this version of handeye reads version {VERSION}: make "
        f"the plan again"
    )
    with pytest.raises(InvalidInput, match=said):
        decode(text, "old.json")


def test_a_plan_that_tells_no_version_is_refused() -> None:
    text = PUMP.read_text(encoding="utf-8").replace(f'"version": {VERSION}', '"version": "new"', 1)
    with pytest.raises(InvalidInput, match=r"^old\.json does not state its version of the plan format$"):
        decode(text, "old.json")


def test_the_committed_schema_is_what_the_types_say() -> None:
    committed = (plans() / "plan.schema.json").read_text(encoding="utf-8")
    assert committed == plan_schema(), "write it again: handeye schema -o plans/plan.schema.json"


def test_the_schema_knows_every_operation_of_the_pump_plan() -> None:
    schema = json.loads(plan_schema())
    tags = {
        d["properties"]["op"]["enum"][0] for d in schema["$defs"].values() if "op" in d.get("properties", {})
    }
    steps = json.loads(PUMP.read_text(encoding="utf-8"))["program"]["steps"]
    assert {step["operation"]["op"] for step in steps} <= tags
