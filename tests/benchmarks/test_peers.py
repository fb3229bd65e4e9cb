"""What `python -m benchmarks vision` and `python -m benchmarks ik` measure, and how they say so."""

import json
from collections.abc import Iterator

import numpy as np
import pytest
from conftest import Command
from synthetic import Canvas, draw_base, part, view

from benchmarks import inverse_kinematics, vision
from benchmarks.peers import Comparison, Outcome, Way
from benchmarks.sights import Sight
from handeye.arm.robots.stanford import STANFORD
from handeye.core.units import DEGREE, INCH

POSE = (44.5 * INCH, 28 * INCH, 90 * DEGREE)
OURS = Way(
    task="holes", name="beams", unit="points",
    outcomes=(Outcome(error=0.1, read=0.05), Outcome(error=0.3, read=0.07), Outcome(error=None)),
    seconds=(0.001, 0.003, 0.002),
)  # fmt: skip
THEIRS = Way(task="holes", name="Otsu", unit="points", outcomes=(Outcome(error=0.2),), seconds=(0.004,))
COMPARED = Comparison(ours=OURS, others=(THEIRS,), missing=("a-library",))


def sight() -> Sight:
    """The base as it is drawn, without noise."""
    base, far, near = part(), Canvas(), Canvas()
    views = view(0.025, base.at[:3]), view(0.050, (POSE[0], POSE[1] + 1.5 * INCH, 2.75 * INCH))
    for canvas, where in zip((far, near), views, strict=True):
        draw_base(canvas, where, base, POSE)
    return Sight(part=base, pose=POSE, far=(far.picture(), views[0]), near=(near.picture(), views[1]))


@pytest.fixture(scope="module")
def compared() -> tuple[Comparison, ...]:
    return tuple(vision.measure([sight()], 1))


def test_everyone_finds_the_holes_of_a_base_drawn_without_noise(compared: tuple[Comparison, ...]) -> None:
    _, holes = compared
    assert [len(way.errors) for way in holes.ways] == [1] * 3
    assert max(way.errors[0] for way in holes.ways) < 1.0


def test_an_outline_of_the_wrong_size_is_not_found(compared: tuple[Comparison, ...]) -> None:
    """Otsu's threshold lies between the drawn plate and face: what hangs together is the face alone."""
    outlines, _ = compared
    assert [len(way.errors) for way in outlines.ways] == [1, 0]
    assert outlines.ours.errors[0] < 5.0


def test_our_own_eye_reads_less_than_a_tenth_of_a_picture(compared: tuple[Comparison, ...]) -> None:
    read = [comparison.ours.outcomes[0].read for comparison in compared]
    assert all(share is not None and 0.01 < share < 0.1 for share in read)


def test_a_hole_that_is_found_elsewhere_is_so_far_off(compared: tuple[Comparison, ...]) -> None:
    seen = sight()
    moved = Sight(part=seen.part, pose=(POSE[0] + 0.1 * INCH, *POSE[1:]), far=seen.far, near=seen.near)
    _, holes = vision.measure([moved], 1)
    assert holes.ours.errors[0] > 1.0 > compared[1].ours.errors[0]


def test_our_inverse_kinematics_reach_every_pose_exactly() -> None:
    compared = inverse_kinematics.measure(STANFORD, 20, 1)
    one_at_a_time, at_once = compared.ways[:2]
    assert len(one_at_a_time.errors) == len(at_once.errors) == 20
    assert max(*one_at_a_time.errors, *at_once.errors) < 1e-9


def test_a_toolbox_that_is_not_installed_is_not_measured(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(inverse_kinematics, "TOOLBOX", "no-such-distribution")
    compared = inverse_kinematics.measure(STANFORD, 2, 1)
    assert compared.missing == ("no-such-distribution",)
    assert len(compared.ways) == 2
    assert (
        compared.lines()[-1] == "hand poses   no-such-distribution: not measured, because it is not installed"
    )


@pytest.fixture
def measured(monkeypatch: pytest.MonkeyPatch) -> None:
    def measure(sights: Iterator[Sight], times: int) -> Iterator[Comparison]:
        assert times == 9
        yield COMPARED

    monkeypatch.setattr("benchmarks.vision.measure", measure)


@pytest.mark.usefixtures("measured")
def test_the_bench_tells_a_person_what_each_way_found_and_how_long_it_took(benchmark: Command) -> None:
    code, out, _ = benchmark("vision")
    assert code == 0
    assert [" ".join(line.split()) for line in out.splitlines()] == [
        "holes beams 2 of 3 0.2, at worst 0.3 points 6.0% read 2.000 ms",
        "holes Otsu 1 of 1 0.2, at worst 0.2 points 4.000 ms 2.00 times ours",
        "holes a-library: not measured, because it is not installed",
    ]


@pytest.mark.usefixtures("measured")
def test_the_bench_tells_a_program_the_same(benchmark: Command) -> None:
    code, out, _ = benchmark("vision", "--json")
    (said,) = json.loads(out)["compared"]
    ours, theirs = said["ways"]
    assert (code, said["not_measured"]) == (0, ["a-library"])
    assert (ours["found"], ours["tried"], ours["median_error"], ours["worst_error"]) == (2, 3, 0.2, 0.3)
    assert ours["median_read"] == pytest.approx(0.06)
    assert (theirs["median_wall_s"], theirs["ratio"], theirs["median_read"]) == (0.004, 2.0, None)


@pytest.mark.parametrize("bench", ["vision", "ik"])
def test_a_bench_wants_to_measure_at_least_once(benchmark: Command, bench: str) -> None:
    said = "handeye: the number of times must be at least 1, not 0\n"
    assert benchmark(bench, "--times", "0") == (2, "", said)


def test_nothing_found_has_no_error() -> None:
    none = Way(task="holes", name="x", unit="points", outcomes=(Outcome(error=None),), seconds=(1.0,))
    told = none.as_json(none)
    assert (told["found"], told["median_error"], told["worst_error"]) == (0, None, None)
    assert np.isclose(none.median_s, 1.0)
