"""The command at the end of a report carries out the same run."""

import shlex
from dataclasses import replace

import msgspec
import pytest
from report_pages import recorded

from handeye.core.faults import Fault
from handeye.core.variation import Overrides, WorldSpec
from handeye.core.world_options import faults, from_start_only, overrides
from handeye.report.facts.again import command
from handeye.report.recorded import RecordedRun
from handeye.tasks import task


@pytest.fixture(scope="module")
def run(tmp_path_factory: pytest.TempPathFactory) -> RecordedRun:
    return recorded(tmp_path_factory.mktemp("run") / "trace.mcap")


def of(run: RecordedRun, **head: object) -> RecordedRun:
    """The run with another beginning."""
    return replace(run, trace=replace(run.trace, head=msgspec.structs.replace(run.trace.head, **head)))


def world_of(words: list[str]) -> WorldSpec:
    """The world that the options of a command stand for."""
    told: dict[str, list[str]] = {}
    for name, value in zip(words[::2], words[1::2], strict=True):
        told.setdefault(name, []).append(value)
    seed = int(told["--seed"][0])
    changed = overrides(
        task().variation(), told.get("--without", []), told.get("--set", []), told.get("--scale", [])
    )
    level = told.get("--level", ["nominal"])[0]
    world = msgspec.convert({"seed": seed, "level": level, "overrides": changed}, WorldSpec)
    broken = faults(task().faults(world), told.get("--fault", []), from_start_only)
    return msgspec.structs.replace(world, faults=broken)


SEVEN = WorldSpec(seed=2**53 - 1, overrides=Overrides(set={"pump.screws": 7.0}))


@pytest.mark.parametrize(
    "world",
    [
        WorldSpec(seed=7),
        WorldSpec(seed=3, level="high"),
        WorldSpec(seed=3, overrides=Overrides(scale={"arm.wave": 1 / 3, "unsourced": 2.0})),
        WorldSpec(seed=3, overrides=Overrides(without=("arm.friction",), set={"camera.place.x": 0.00762})),
        WorldSpec(seed=3, overrides=Overrides(set={"camera.place.x": 0.1 + 0.2 - 0.3 + 1 / 300})),
        WorldSpec(
            seed=3, faults=faults(task().faults(SEVEN), ["gasket.off.x=6mm", "pin.1.missing"], from_start_only)
        ),
        msgspec.structs.replace(SEVEN, faults=(Fault(name="screw.7.missing"),)),
    ],
    ids=str,
)  # fmt: skip
def test_its_options_stand_for_the_same_world(run: RecordedRun, world: WorldSpec) -> None:
    typed = command(of(run, world=world))
    assert typed is not None
    words = shlex.split(typed)
    assert world_of(words[words.index("--seed") :]) == world


def test_the_shipped_plan_is_assembled_and_another_one_is_run(run: RecordedRun) -> None:
    assert shlex.split(command(run) or "")[:3] == ["handeye", "run", "plan.json"]


def test_there_is_none_where_code_of_the_caller_belongs_to_the_run(run: RecordedRun) -> None:
    assert command(of(run, replaced={"camera": "fog.Foggy"})) is None
