"""What a run costs the host: summed over its sessions, and no part of the run."""

from pathlib import Path

import pytest
from toy_system import begin_toy

from handeye.core.errors import InvalidInput
from handeye.core.host_time import HostTimer
from handeye.runs.advance import advance
from handeye.runs.checkpoint_file import encode
from handeye.runs.folder import HOST, open_again, open_new
from handeye.runs.host_seconds import HostSeconds, Meter, read_host_seconds, write_host_seconds
from handeye.runs.runner import Runner

BEFORE = HostSeconds(planning_cpu_s=0.5, vision_cpu_s=0.25, run_cpu_s=6.0, run_wall_s=20.0)


class Spent(HostTimer):
    """A session that has cost 2 s of the processor in 10 s."""

    wall_s = 10.0
    cpu_s = 2.0


def test_a_session_adds_to_those_before_and_loses_nothing() -> None:
    runner = Runner(begin_toy())
    runner.vision.seconds = 0.125
    assert Meter(timer=Spent(), before=BEFORE).seconds(runner) == HostSeconds(
        planning_cpu_s=0.5, vision_cpu_s=0.375, run_cpu_s=8.0, run_wall_s=30.0
    )


def test_a_run_whose_past_nobody_measured_says_from_where_on_it_is() -> None:
    runner = Runner(begin_toy())
    advance(runner, steps=4)
    resumed = Runner(runner.checkpoint())
    advance(resumed, steps=2)
    seconds = Meter(timer=Spent()).seconds(resumed)
    assert (seconds.from_step, seconds.from_clock_s, seconds.run_wall_s) == (4, 4.0, 10.0)


def test_the_seconds_of_a_session_that_was_killed_are_kept_with_its_last_checkpoint(tmp_path: Path) -> None:
    start = begin_toy()
    folder = open_new(tmp_path / "run", start)
    meter = Meter(timer=Spent(), planning_cpu_s=0.5)
    runner = Runner(start, observers=lambda r: [folder.watch(r, start, again=False, meter=meter)])
    advance(runner, steps=1)
    assert open_again(tmp_path / "run")[0].spent == HostSeconds(
        planning_cpu_s=0.5, run_cpu_s=2.0, run_wall_s=10.0
    )
    folder.close()


def test_no_second_of_the_host_enters_a_checkpoint() -> None:
    runner = Runner(begin_toy())
    before = encode(runner.checkpoint())
    runner.vision.seconds = 3.5
    advance(runner, steps=1)
    runner.back_to(0)
    assert encode(runner.checkpoint()) == before


@pytest.mark.parametrize(
    "written",
    ["", "[]", "{", '{"run_wall_s": "10"}', '{"run_wall_s": -1}', '{"seconds": 1}', '{"run_wall_s": 1e999}', "\udcff"],
)  # fmt: skip
def test_a_record_of_seconds_that_cannot_be_used_is_refused_by_name(tmp_path: Path, written: str) -> None:
    (tmp_path / HOST).write_bytes(written.encode(errors="surrogateescape"))
    with pytest.raises(InvalidInput, match=rf"{HOST} is not a timing record: "):
        read_host_seconds(tmp_path / HOST)


def test_a_record_of_seconds_is_read_as_it_was_written(tmp_path: Path) -> None:
    write_host_seconds(tmp_path / HOST, BEFORE)
    assert (read_host_seconds(tmp_path / HOST), read_host_seconds(tmp_path / "none")) == (BEFORE, None)
