"""The walk in docs/stepping.md shows what there is to see, line by line, with the same commands."""

import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from figures import as_recorded

from handeye.debugger.breakpoints import stage_number
from handeye.debugger.formatting import MOST, as_text
from handeye.debugger.listing import listing_text
from handeye.debugger.stepper import Stepper
from handeye.planfile.plan import Plan
from handeye.planfile.store import read_plan
from handeye.resources import plans
from handeye.runs.advance import advance
from handeye.runs.runner import Runner
from handeye.runs.setup import Setup
from handeye.runs.snapshot import Checkpoint
from handeye.runs.stops import AfterStage
from handeye.trace.account import account
from handeye.variation import WorldSpec

DOC = (Path(__file__).parent.parent / "docs" / "stepping.md").read_text(encoding="utf-8")
BLOCKS = re.findall(r"^```\n(.*?)^```$", DOC, re.MULTILINE | re.DOTALL)
SEED = 0
SAID = "handeye> "


def of_command(words: str) -> list[str]:
    """What the walk shows behind a command of the shell, up to the next."""
    (shown,) = [block.split("\n$ ")[0] for block in BLOCKS if block.startswith(f"$ handeye {words}")]
    return shown.splitlines()[1:]


def pieces(lines: list[str]) -> list[list[str]]:
    """What stands between the dots for lines left out."""
    found: list[list[str]] = [[]]
    for line in lines:
        if line.strip() == "...":
            found.append([])
        else:
            found[-1].append(line)
    return [piece for piece in found if piece]


def stands(piece: list[str], lines: list[str]) -> bool:
    """A piece is there somewhere, line after line."""
    recorded = "\n".join(piece)
    ways = ["\n".join(lines[start : start + len(piece)]) for start in range(len(lines))]
    return any(as_recorded(way, recorded) == recorded for way in ways)


@pytest.fixture(scope="module")
def plan() -> Plan:
    return read_plan(plans() / "water_pump.plan.json")


@pytest.fixture(scope="module")
def stepper(plan: Plan) -> Stepper:
    """The run of the walk, where its commands begin."""
    runner = Runner(Checkpoint(setup=Setup(plan=plan, world=WorldSpec(seed=SEED), camera="auto")))
    if runner.cell.renderer.method != "opengl":
        pytest.skip("the walk was made with pictures by OpenGL")
    before = stage_number("insert", plan.program) - 1
    advance(runner, [AfterStage(stage=before, name=runner.stages[before])])
    return Stepper(runner)


def transcript(stepper: Stepper, commands: list[str]) -> Iterator[str]:
    """What stands on the terminal of somebody who says these commands."""
    yield as_text(stepper.standing())
    for command in commands:
        yield f"{SAID}{command}"
        yield as_text(stepper.do(command), MOST)


def test_the_stages_of_the_walk_are_those_of_the_plan(plan: Plan) -> None:
    listed = "\n".join(listing_text(plan.program))
    shown = pieces(of_command("stages plans/water_pump.plan.json"))
    assert shown
    assert all("\n".join(piece) in listed for piece in shown)


@pytest.mark.slow
@pytest.mark.render
def test_the_commands_of_the_walk_are_answered_as_it_shows_and_their_trace_tells_what_it_shows(
    stepper: Stepper,
) -> None:
    shown = of_command(
        f"run plans/water_pump.plan.json --seed {SEED} --checkpoints pump --from insert --step"
    )
    for block in BLOCKS:
        shown += block.splitlines() if block.startswith(SAID) else []
    commands = [line.removeprefix(SAID) for line in shown if line.startswith(SAID)]
    assert len(commands) >= 10
    said = "\n".join(transcript(stepper, commands))
    assert as_recorded(said, "\n".join(shown)).splitlines() == shown
    told = list(account(stepper.hands.runner.events))
    assert all(stands(piece, told) for piece in pieces(of_command("trace show pump")))
