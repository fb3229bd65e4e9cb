"""The typewriter: two decks of symbolic statements as one program, and a referee for the bar and the support."""

import json
from collections.abc import Callable
from pathlib import Path

import mujoco
import pytest

from handeye.core.errors import NoSuchName
from handeye.core.resources import plans
from handeye.core.source import Source, read_source
from handeye.core.variation import WorldSpec
from handeye.runs.runner import Runner
from handeye.runs.snapshot import Checkpoint
from handeye.systems.ml.bench.bars import turned
from handeye.systems.ml.language.assembler import assembled
from handeye.systems.ml.run.jobs import job_plan, job_setup
from handeye.systems.ml.support.drawing import FRAME, mm
from handeye.systems.ml.typewriter.task import BAD, BAR, HOPPER, TYPEWRITER

MM = 0.001
PLANS = plans()
BARS = 4
WORLD = WorldSpec(seed=1)  # the third of its four bars is too light


def test_the_program_runs_on_from_its_own_deck_into_that_of_the_support() -> None:
    own, support = (read_source(plans() / name).text for name in ("typewriter.sym", "support.sym"))
    text = job_plan("typewriter").text
    alone, _ = assembled(Source(name="support.sym", text=support))
    remarks = [line for line in text.splitlines() if line.startswith("*")]
    assert remarks == [line.strip() for line in (own + support).splitlines() if line.startswith("*")]
    count = sum(not line.startswith("*") for line in alone.split("\n") if line)
    assert [line.split()[1:2] for line in text.splitlines()[-count:]] == [
        line.split()[1:2] for line in alone.splitlines()[-count:]
    ]


def test_a_mistake_in_a_later_deck_is_found_there() -> None:
    first = Source(
        name="a.sym",
        text="  LOAD 1 2\n",
        required=(Source(name="b.sym", key="b.sym", text="  STOP\n  BRANCH X\n"),),
    )
    _, (wrong,) = assembled(first)
    part, offset = first.find(wrong.primary.span.start)
    assert (part.name, part.position(offset)[0]) == ("b.sym", 2)


def test_decks_are_assembled_by_one_command(
    command: Callable[..., tuple[int, str, str]], tmp_path: Path
) -> None:
    (tmp_path / "a.sym").write_text("A EQU 7\n  LOAD 1 A\n", encoding="utf-8")
    (tmp_path / "b.sym").write_text("  BRANCH HERE\nHERE: ADD 1 A\n", encoding="utf-8")
    code, out, _ = command("ml", "assemble", str(tmp_path / "a.sym"), str(tmp_path / "b.sym"))
    assert (code, out.split("\n")) == (0, ["5 LOAD 1 7", "", "10 BRANCH 15", "15 ADD 1 7", "", ""])
    assert command("ml", "check", str(tmp_path / "a.sym"), str(tmp_path / "b.sym"))[0] == 0
    code, _, told = command("ml", "assemble", str(tmp_path / "b.sym"))
    assert (code, "b.sym:2" in told) == (2, True)
    code, _, told = command("ml", "check", str(PLANS / "orient.ml"), str(tmp_path / "b.sym"))
    assert (code, told) == (2, "handeye: only symbolic programs (.sym) can consist of several files\n")


def test_the_symbolic_programs_of_the_jobs_have_no_mistakes(
    command: Callable[..., tuple[int, str, str]],
) -> None:
    for files in (["support.sym"], ["curve_follower.sym"], ["typewriter.sym", "support.sym"]):
        assert command("ml", "check", *(str(PLANS / file) for file in files))[0] == 0


def test_a_bin_takes_as_many_bars_as_the_bin_job() -> None:
    with pytest.raises(NoSuchName, match="the bin holds 1 to 12 parts, not `40`"):
        TYPEWRITER.hardware(job_plan("typewriter", "40"), WORLD, lambda _: None)


@pytest.mark.slow
def test_matrices_are_dense_only_while_several_bars_move() -> None:
    """Where many parts touch each other, dense matrices take 40 ms a step. A pile needs them."""
    bench = TYPEWRITER.station(BARS, TYPEWRITER.world(WORLD))[0].bench
    model, data = bench.model, bench.data
    trees = [int(model.body_treeid[model.body(f"part_{number}").id]) for number in range(1, BARS + 1)]
    for awake, dense in ((4, True), (2, True), (1, False), (0, False)):
        data.tree_asleep[trees] = [-1] * awake + trees[awake:]
        for act in bench.before_step:
            act()
        assert mujoco.mj_isSparse(model) != dense


@pytest.mark.slow
def test_the_referee_sees_a_bar_that_is_bad_missing_lost_or_wrongly_rejected() -> None:
    runner = Runner(Checkpoint(setup=job_setup(job_plan("typewriter", str(BARS)), WORLD)))
    data, cell = runner.cell.truth.data, runner.cell
    frame, at = data.body("frame").xpos.copy(), mm(*BAR)
    there = (frame[0] + at.x * MM, frame[1] + at.y * MM, (FRAME[2] + 7) * MM)
    along = turned("z", 1.5708)
    bad = mm(*BAD)

    def wrong(**places: tuple[float, float, float]) -> list[str]:
        for number in range(1, BARS + 1):
            hidden = (mm(*HOPPER).x * MM, mm(*HOPPER).y * MM, 0.1 + number * 0.05)
            data.joint(f"part_{number}").qpos[:] = (*places.get(f"bar_{number}", hidden), *along)
        cell.restore(cell.capture())
        found = TYPEWRITER.judge(cell.truth)
        return [name for name in ("bar", "passed", "rejected", "lost") if not found[name].ok]

    assert wrong(bar_1=there) == []
    assert wrong(bar_3=there) == ["passed"]
    assert wrong() == ["bar"]
    assert wrong(bar_1=(there[0] + 0.002, *there[1:])) == ["bar", "lost"]
    assert wrong(bar_1=there, bar_2=(bad.x * MM, bad.y * MM, 0.01)) == ["rejected"]
    assert wrong(bar_1=there, bar_3=(bad.x * MM, bad.y * MM, 0.01)) == []


@pytest.mark.slow
def test_the_faults_of_the_typewriter_are_listed(command: Callable[..., tuple[int, str, str]]) -> None:
    code, out, _ = command("faults", "--task", "typewriter", "--list", "--json")
    assert (code, "bin.empty" in json.dumps(json.loads(out))) == (0, True)
