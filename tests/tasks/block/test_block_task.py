"""A task that handeye knows nothing of: a small Cartesian arm, a block, a referee of three points."""

import json
from pathlib import Path

import pytest
from block_task import BLOCK, block_plan

from handeye.core.variation import Overrides, WorldSpec
from handeye.debugger.stepper import Stepper
from handeye.judge.finding import all_right
from handeye.planfile.store import decode, encode
from handeye.runs.advance import advance
from handeye.runs.checkpoint_file import encode as encode_checkpoint
from handeye.runs.checkpoint_file import read_checkpoint, write_checkpoint
from handeye.runs.folder import EVENTS, TRACE, open_new
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint, Setup
from handeye.runs.verify import difference
from handeye.trace.reading import read_trace

pytestmark = pytest.mark.slow


def begin(seed: int = 0, **overrides: float) -> Checkpoint:
    world = WorldSpec(seed=seed, overrides=Overrides(set=overrides))
    return Checkpoint(setup=Setup(plan=block_plan(), world=world, camera="ray"))


def kept(folder: Path, start: Checkpoint) -> Runner:
    """A run to its end, kept in a folder."""
    keeping = open_new(folder, start)
    runner = Runner(start, observers=lambda runner: [keeping.watch(runner, start, again=False)])
    advance(runner)
    runner.finish()
    keeping.close()
    return runner


def test_the_planner_plans_for_the_small_arm_and_the_plan_is_sound_on_disk() -> None:
    plan = block_plan()
    assert plan.joint_counts == (3,)
    assert decode(encode(plan), "block.plan.json") == plan


@pytest.mark.parametrize("seed", [0, 1, 2])
def test_the_executor_puts_the_block_where_the_referee_wants_it(seed: int) -> None:
    runner = Runner(begin(seed))
    assert advance(runner).kind == "end"
    findings = BLOCK.judge(runner.cell.truth)
    assert all_right(findings), findings


def test_the_referee_sees_a_block_that_was_never_there_to_be_moved() -> None:
    runner = Runner(begin())
    assert [name for name, finding in BLOCK.judge(runner.cell.truth).items() if not finding.ok] == ["place"]


def test_a_block_out_of_the_hands_way_calls_the_operator_with_error_2() -> None:
    runner = Runner(begin(**{"block.x": 0.05}))
    pause = advance(runner)
    assert (pause.kind, pause.error) == ("operator", 2)


def test_the_stepper_steps_goes_back_and_gives_the_same_events() -> None:
    through = Runner(begin())
    advance(through)
    stepped = Stepper(Runner(begin()))
    for line in ("step 3", "back 2", "until put it down", "back stage", "continue"):
        assert stepped.do(line).error is None, line
    assert stepped.session.runner.events == through.events


def test_a_checkpoint_on_disk_goes_on_to_the_same_end(tmp_path: Path) -> None:
    whole = Runner(begin())
    advance(whole)
    broken = Runner(begin())
    advance(broken, steps=3)
    write_checkpoint(tmp_path / "a.checkpoint", broken.checkpoint())
    resumed = Runner(read_checkpoint(tmp_path / "a.checkpoint"))
    advance(resumed)
    assert resumed.events == whole.events
    assert encode_checkpoint(resumed.checkpoint()) == encode_checkpoint(whole.checkpoint())


def test_its_trace_is_written_read_and_comes_out_the_same_again(tmp_path: Path) -> None:
    runner = kept(tmp_path / "one", begin())
    trace = read_trace(tmp_path / "one" / TRACE)
    assert list(trace.events) == runner.events
    assert trace.joints.shape[1] == 3
    assert difference(trace, tmp_path / "two") is None
    assert json.loads((tmp_path / "one" / EVENTS).read_text().splitlines()[0])["task"] == "block"
