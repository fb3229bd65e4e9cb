"""Every version of the plan format ever released can be read, and the schema says what the types say."""

import json
from collections.abc import Callable
from pathlib import Path
from typing import Any

import pytest

from handeye.arm.model import digest
from handeye.arm.robots.stanford import STANFORD
from handeye.core.errors import InvalidInput
from handeye.core.resources import plans
from handeye.inspection.difference import difference
from handeye.planfile import migrations
from handeye.planfile.plan import VERSION
from handeye.planfile.schema import plan_schema
from handeye.planfile.store import decode, encode, read_plan
from handeye.planfile.version_1 import to_version_2
from handeye.program.guards import Against, Force, Guards, Moment, Torque, Touch

VERSIONS = Path(__file__).parent / "versions"
PRESENT = VERSIONS / f"{VERSION}.plan.json"


def as_version_0(data: dict[str, Any]) -> dict[str, Any]:
    """A plan in a format that never was: the speed in per cent, under another name."""
    return {("percent" if k == "speed" else k): v for k, v in data.items()} | {
        "version": 0,
        "percent": data["speed"] * 100,
    }


def from_version_0(data: dict[str, Any]) -> dict[str, Any]:
    rest = {key: value for key, value in data.items() if key != "percent"}
    return rest | {"speed": data["percent"] / 100}


@pytest.fixture
def old(monkeypatch: pytest.MonkeyPatch) -> Callable[[], dict[str, Any]]:
    monkeypatch.setattr(migrations, "MIGRATIONS", migrations.MIGRATIONS | {0: from_version_0})
    return lambda: as_version_0(json.loads(PRESENT.read_text(encoding="utf-8")))


KEPT = sorted(VERSIONS.glob("*.plan.json"))


def test_a_plan_of_every_version_is_kept() -> None:
    versions = {json.loads(path.read_text(encoding="utf-8"))["version"] for path in KEPT}
    assert versions == set(range(1, VERSION + 1))


@pytest.mark.parametrize("path", KEPT, ids=[path.name for path in KEPT])
def test_a_plan_that_is_kept_can_be_read(path: Path) -> None:
    written = json.loads(path.read_text(encoding="utf-8"))
    plan = read_plan(path)
    assert plan.version == VERSION
    assert [s.text for s in plan.program.steps] == [s["text"] for s in written["program"]["steps"]]


def test_the_pump_planned_in_version_1_does_what_it_does_in_version_2() -> None:
    found = difference(read_plan(VERSIONS / "1.fixtures.plan.json"), read_plan(VERSIONS / "2.plan.json"))
    assert found.same, found


def test_labels_and_places_that_version_1_did_not_say_are_read_off_its_source() -> None:
    old, new = (read_plan(VERSIONS / name).program.steps for name in ("1.fixtures.plan.json", "2.plan.json"))
    assert [(s.labels, s.macro, s.span) for s in old] == [(s.labels, s.macro, s.span) for s in new]


def as_version_1(source: str, lines: dict[int, str]) -> dict[str, list[tuple[str, ...]]]:
    """Labels and macros of steps of version 1, by the lines they come from."""
    steps = [{"operation": {"op": "jump"}, "line": line, "text": text} for line, text in lines.items()]
    plan = {"arm_digest": "", "program": {"source": source, "steps": steps}}
    return {
        s["text"]: [*s.get("labels", ()), s.get("macro", "")] for s in to_version_2(plan)["program"]["steps"]
    }


def test_a_label_of_version_1_goes_to_the_step_on_its_line_or_below() -> None:
    source = (
        "A: PARK\nB:\n; why\nC: D: STOP 5\nCHANGE Z 1\nE: TWICE\nOPEN 1\nDEFINE TWICE\nF: OPEN 2\n\nOPEN 3"
    )
    lines = {1: "PARK", 5: "CHANGE Z 1", 7: "OPEN 1", 9: "OPEN 2", 11: "OPEN 3"}
    assert as_version_1(source, lines) == {
        "PARK": ["A", ""],
        "CHANGE Z 1": ["B", "C", "D", ""],
        "OPEN 1": [""],  # a call of a macro is no step: what its label is of is not known
        "OPEN 2": ["F", "TWICE"],
        "OPEN 3": [""],
    }


@pytest.mark.parametrize("path", KEPT, ids=[path.name for path in KEPT])
def test_a_plan_that_is_kept_can_be_run_on_the_arm_of_today(path: Path) -> None:
    assert read_plan(path).arm_digest == digest(STANFORD)


def stopped(stop: dict[str, Any]) -> str:
    """The first plan of version 1 with another stop of its first motion that has one."""
    data = json.loads((VERSIONS / "1.plan.json").read_text(encoding="utf-8"))
    operations = [step["operation"] for step in data["program"]["steps"]]
    next(operation for operation in operations if operation.get("stop"))["stop"] = stop
    return json.dumps(data)


@pytest.mark.parametrize(
    ("stop", "guards"),
    [
        ({"force": [0, 0, -3], "torque": None}, (Force(force=(0, 0, -3)),)),
        ({"against": 2.0}, (Against(force=2.0),)),
        ({"torque": 0.5}, (Torque(torque=0.5),)),
        ({"touch": 3}, (Touch(fingers=3),)),
        ({"against": 2.0, "moment": [0, 0, 1]}, (Against(force=2.0), Moment(moment=(0, 0, 1)))),
    ],
)
def test_a_stop_of_version_1_is_read_as_its_guards(stop: dict[str, Any], guards: Guards) -> None:
    steps = decode(stopped(stop), "old.json").program.steps
    assert next(step.operation.guards for step in steps if step.operation.guards) == guards


@pytest.mark.parametrize("stop", [{}, {"force": [0, 0, -3], "touch": 3}, {"torque": 1, "moment": [0, 0, 1]}])
def test_a_stop_of_version_1_that_had_not_one_condition_is_refused(stop: dict[str, Any]) -> None:
    with pytest.raises(InvalidInput, match=r"^old\.json is not a sound plan of format version 1$"):
        decode(stopped(stop), "old.json")


def test_every_version_before_the_present_one_has_its_migration() -> None:
    assert set(migrations.MIGRATIONS) == set(range(1, VERSION))


def test_an_older_plan_comes_out_as_the_same_plan_in_the_present_version(
    old: Callable[[], dict[str, Any]],
) -> None:
    assert encode(decode(json.dumps(old()), "old.json")) == encode(read_plan(PRESENT))


def test_an_older_plan_that_is_not_sound_is_refused_in_one_sentence(
    old: Callable[[], dict[str, Any]],
) -> None:
    data = old()
    del data["percent"]
    with pytest.raises(InvalidInput, match=r"^old\.json is not a sound plan of format version 0$"):
        decode(json.dumps(data), "old.json")


def test_what_a_migration_leaves_is_checked_as_any_plan_is(old: Callable[[], dict[str, Any]]) -> None:
    with pytest.raises(InvalidInput, match=r"^old\.json: its speed is 7; a share of"):
        decode(json.dumps(old() | {"percent": 700.0}), "old.json")


def test_a_version_from_before_the_first_is_refused() -> None:
    text = PRESENT.read_text(encoding="utf-8").replace(f'"version": {VERSION}', '"version": 0', 1)
    with pytest.raises(
        InvalidInput, match=r"^old\.json does not say which version of the plan format it has$"
    ):
        decode(text, "old.json")


def test_the_committed_schema_is_what_the_types_say() -> None:
    committed = (plans() / "plan.schema.json").read_text(encoding="utf-8")
    assert committed == plan_schema(), "write it again: handeye schema -o plans/plan.schema.json"


def test_the_schema_knows_every_operation_of_the_pump_plan() -> None:
    schema = json.loads(plan_schema())
    tags = {
        d["properties"]["op"]["enum"][0] for d in schema["$defs"].values() if "op" in d.get("properties", {})
    }
    steps = json.loads(PRESENT.read_text(encoding="utf-8"))["program"]["steps"]
    assert {step["operation"]["op"] for step in steps} <= tags
