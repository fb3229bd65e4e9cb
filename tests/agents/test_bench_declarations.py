"""How tasks of the agents' bench are declared: derived files, variants, and where bodies must be."""

from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from handeye.agents.bench_files import Derived, TaskFiles
from handeye.agents.bench_right import Body, Measured
from handeye.agents.bench_task import bench_task, read_task
from handeye.core.errors import BadFile


def files(folder: Path, **derived: Derived) -> TaskFiles:
    named = {name.replace("_", "/") + ".al": each for name, each in derived.items()}
    return TaskFiles(folder, named, lambda name: bench_task(name).files)


def test_a_file_is_derived_by_changes_in_their_order(tmp_path: Path) -> None:
    (tmp_path / "given").mkdir()
    (tmp_path / "given/a.al").write_text("OPEN 1\nOPEN 2\n")
    changes = [("OPEN 1\n", "OPEN 3\n"), ("OPEN 3", "OPEN 4")]
    made = files(tmp_path, reference_b=Derived(source="given/a.al", changes=changes))
    assert made.read("reference") == {"b.al": b"OPEN 4\nOPEN 2\n"}
    assert made.read("given") == {"a.al": b"OPEN 1\nOPEN 2\n"}


def test_a_change_that_fits_nowhere_or_twice_is_refused(tmp_path: Path) -> None:
    (tmp_path / "given").mkdir()
    (tmp_path / "given/a.al").write_text("OPEN 1\nOPEN 1\n")
    for old in ("CLOSE 1", "OPEN 1"):
        made = files(tmp_path, given_b=Derived(source="given/a.al", changes=[(old, "")]))
        with pytest.raises(BadFile, match=rf"given/b\.al: `{old}` must occur exactly once in given/a\.al"):
            made.read("given")


def test_a_file_that_is_derived_from_itself_is_refused(tmp_path: Path) -> None:
    one, other = Derived(source="given/b.al"), Derived(source="given/a.al")
    with pytest.raises(BadFile, match="is derived from itself"):
        files(tmp_path, given_a=one, given_b=other).read("given")


def test_a_world_has_the_variant_of_its_seed() -> None:
    task = bench_task("honest_search")
    assert [bool(task.case(seed).right.stops) for seed in (0, 1, 2, 10**15 + 1)] == [False, True, False, True]
    assert task.world(1).overrides.set["plate.x"] == pytest.approx(0.020)
    assert task.world(2).overrides.set == {}
    assert [each.name for each in bench_task("empty_holder").world(3).faults] == ["pin.absent"]


def test_a_variant_changes_lines_of_the_solution(tmp_path: Path) -> None:
    task = bench_task("any_stack")
    for name, data in task.solution("reference").items():
        (tmp_path / name).write_bytes(data)
    scripts = [setup.plan.script for setup in task.setups(tmp_path, [0, 1])]  # type: ignore[attr-defined]
    assert [script.count("* STACK 3 X 150 Y 0") for script in scripts] == [0, 2]


def test_a_declaration_with_an_unknown_word_is_refused(tmp_path: Path) -> None:
    text = (bench_task("pin").folder / "task.toml").read_text(encoding="utf-8")
    (tmp_path / "task.toml").write_text(text + "\n[right]\nstop = 1\n")
    with pytest.raises(BadFile, match="contains unknown field `stop`"):
        read_task(tmp_path)


def truth(x: float, y: float, yaw: float = 0.0, lean: float = 0.0) -> Any:
    """A part (mm, deg) on a table that is 100 mm along x."""
    yaw, lean = np.radians(yaw), np.radians(lean)
    R = np.array([[np.cos(yaw), -np.sin(yaw), 0], [np.sin(yaw), np.cos(yaw), 0], [0, 0, np.cos(lean)]])
    part = SimpleNamespace(xpos=np.array([x, y, 6]) / 1000, xmat=R.ravel())
    table = SimpleNamespace(xpos=np.array([0.1, 0, 0]), xmat=np.eye(3).ravel())
    bodies = {"part_1": part, "table": table}
    lines = SimpleNamespace(lines=("0  120",))
    return SimpleNamespace(
        data=SimpleNamespace(body=bodies.__getitem__, geom=bodies.__getitem__), states={"heard": lines}
    )


@pytest.mark.parametrize(
    ("at", "wrong"),
    [
        (truth(150, 20), []),
        (truth(152.9, 20), []),
        (truth(153.1, 20), ["part_1.place"]),
        (truth(150, 20, yaw=94), []),
        (truth(150, 20, yaw=-96), ["part_1.turned"]),
        (truth(150, 20, lean=4), ["part_1.lean"]),
    ],
)
def test_a_body_must_be_at_its_place(at: Any, wrong: list[str]) -> None:
    body = Body(name="part_1", frame="table", x=50, y=20, turned=0, fold=90)
    assert [name for name, finding in body.findings(at).items() if not finding.ok] == wrong


@pytest.mark.parametrize(("printed", "error"), [(r"^0 +(\d+)", 20.0), (r"^1 +(\d+)", float("inf"))])
def test_a_printed_value_is_compared_with_the_truth(printed: str, error: float) -> None:
    measured = Measured(printed=printed, geom="part_1", axis="x", scale=-1, offset=250, within=1)
    (found,) = measured.findings(truth(150, 0)).values()
    assert (found.value, found.ok) == (error, False)
