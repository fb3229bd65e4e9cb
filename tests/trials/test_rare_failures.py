"""`handeye trials rare`: the estimate, checked where the probability is known; margins; worlds as points and files."""

import math
from collections.abc import Callable, Sequence
from statistics import NormalDist, mean

import numpy as np
import pytest
from results import result

from handeye.core.distributions import random_numbers
from handeye.core.variation import Overrides, WorldSpec
from handeye.judge.finding import at_least, at_most
from handeye.results.result import Check
from handeye.tasks import task
from handeye.trials.rare.nearest import HALVINGS, simplified
from handeye.trials.rare.points import Point, WorldSpace
from handeye.trials.rare.row import Margin, RareRow, Usual, limits_left, usual
from handeye.trials.rare.subset import Level, estimate, subset_simulation

NORMAL = NormalDist()
NUMBERS, FAR = 20, 3.2  # quantities, and distance of the failure from the middle: P = 6.9e-4
FAILS = NORMAL.cdf(-FAR)


def noise_of(seed: int) -> float:
    """A standard normal number from a seed."""
    return NORMAL.inv_cdf((seed * 2654435761 % 2**32 + 0.5) / 2**32)


def plane(noisy: float) -> Callable[[int, Sequence[Point]], list[float]]:
    """Margins from a failure beyond a plane. A share `noisy` of the variance is that of the noise."""
    along, across = math.sqrt((1 - noisy) / NUMBERS), math.sqrt(noisy)
    return lambda _, points: [
        FAR - along * float(each.numbers.sum()) - (across * noise_of(each.noise) if noisy else 0.0)
        for each in points
    ]


def simulated(seed: int, margins: Callable[[int, Sequence[Point]], list[float]], n: int = 100) -> list[Level]:
    """The levels of a simulation with `n` worlds a level."""
    rng = random_numbers(seed, "first")
    first = [Point(rng.standard_normal(NUMBERS), int(rng.integers(2**53))) for _ in range(n)]
    return [*subset_simulation(first, margins, lambda level: random_numbers(seed, f"level {level}"), 8)]


@pytest.mark.slow
@pytest.mark.parametrize("noisy", [0.0, 0.2])
def test_the_estimate_is_near_the_known_probability_and_most_intervals_contain_it(noisy: float) -> None:
    found = [estimate(simulated(seed, plane(noisy))) for seed in range(12)]
    assert mean(math.log(each.probability / FAILS) for each in found) == pytest.approx(0, abs=0.6)
    assert sum(each.low <= FAILS <= each.high for each in found) >= 9


def test_a_failure_that_is_not_rare_is_counted() -> None:
    (level,) = simulated(0, lambda _, points: [0.0 if each.numbers[0] > 0 else 1.0 for each in points])
    assert level.reached
    assert level.share == level.failed / 100
    assert 35 <= level.failed <= 65
    assert level.variation == pytest.approx(math.sqrt((1 - level.share) / (100 * level.share)))


def test_runs_that_all_have_the_same_margin_give_no_next_level() -> None:
    (level,) = simulated(0, lambda _, points: [1.0 for _ in points])
    assert (level.stuck, level.reached, level.failed) == (True, False, 0)


def test_a_sample_of_few_margins_goes_on_to_the_next_smaller_one() -> None:
    first = simulated(0, lambda _, points: [1.0 if each.numbers[0] < 1.5 else 0.5 for each in points])[0]
    assert first.threshold == 0.5
    assert first.share < 0.2


@pytest.mark.parametrize("level", ["low", "nominal", "high"])
def test_the_point_of_a_seed_is_the_world_of_this_seed(level: str) -> None:
    work, base = task("insertion"), WorldSpec(seed=7, level=level, overrides=Overrides(scale={"plate": 1.5}))  # type: ignore[arg-type]
    space = WorldSpace(work.variation(), base)
    drawn, made = (work.variation().draw(spec).values for spec in (base, space.world(space.seeded(7))))
    assert drawn.keys() == made.keys()
    assert [made[name] for name in drawn] == pytest.approx([*drawn.values()], rel=1e-9, abs=1e-12)


def test_a_quantity_that_is_set_or_switched_off_is_no_coordinate() -> None:
    base = WorldSpec(
        seed=7, overrides=Overrides(set={"plate.x": 0.001}, without=("hand",), scale={"arm.offset": 0.0})
    )
    space = WorldSpace(task("insertion").variation(), base)
    assert not [name for name in space.names if name.startswith(("plate.x", "hand.", "arm.offset."))]
    made = space.world(space.seeded(8))
    assert (made.seed, made.overrides.set["plate.x"], made.overrides.without) == (8, 0.001, ("hand",))


def test_a_deviation_beyond_the_range_of_a_quantity_is_not_counted() -> None:
    space = WorldSpace(task("insertion").variation(), WorldSpec(seed=0))
    numbers = np.zeros(len(space.names))
    numbers[space.names.index("plate.x")] = -5.0
    assert space.distance(numbers) == 2.0
    assert space.told(numbers, [space.names.index("plate.x")]) == {"plate.x": -2.0}


def checks() -> dict[str, Check]:
    found = {
        "gap": at_most(0.05, 0.2, "mm", "gap"),
        "force": at_least(60, 40, "N", "force"),
        "count": at_least(6, 6, "screws", "screws"),
        "scars": at_most(0, 0, "threads", "scars", caution=True),
    }
    return {name: Check.of(each) for name, each in found.items()}


def test_a_finding_that_is_a_count_or_a_caution_says_nothing_about_the_margin() -> None:
    assert limits_left(checks()) == {"gap": pytest.approx(0.15), "force": 20}


def row(outcome: str, left: dict[str, float] | None = None, **checks: Check) -> RareRow:
    """A run that ended `right`, `silent` or `stopped`."""
    done = result(completed=outcome != "stopped", assembled=outcome == "right", checks=checks)
    return RareRow(trial=0, seed=0, result=done, left=left or {})


def test_the_margin_of_a_silent_failure_is_negative_and_names_the_finding() -> None:
    known = Usual(program={}, referee={"gap": 0.15, "force": 20})
    wrong = row("silent", **checks() | {"gap": Check.of(at_most(0.5, 0.2, "mm", "gap"))})
    assert known.margin(wrong, "silent") == Margin(value=pytest.approx(-2.0), part="gap")
    assert known.margin(wrong, "stopped").value == 1.0


def test_the_margin_of_a_right_run_is_its_least_part_as_a_share_of_what_is_usual() -> None:
    known = Usual(program={"search": 40, "gap": 2.0}, referee={"gap": 0.3, "force": 20})
    right = row("right", {"search": 10, "gap": 1.5, "other": 0.0}, **checks())
    assert known.margin(right, "stopped") == Margin(value=0.25, part="search")
    assert known.margin(right, "silent") == Margin(value=pytest.approx(0.5), part="gap")


def test_a_right_run_at_its_last_place_has_not_failed() -> None:
    assert Usual(program={"search": 40}, referee={}).margin(row("right", {"search": 0}), "stopped").value > 0


def test_a_stopped_run_is_at_the_failure_and_says_nothing_about_silence() -> None:
    known = Usual(program={}, referee={})
    assert known.margin(row("stopped"), "stopped").value == 0
    assert known.margin(row("stopped"), "silent").value == math.inf


def test_a_run_that_was_broken_off_counts_as_stopped() -> None:
    broken = RareRow(trial=0, seed=0, ended="raised", raised="ValueError: no")
    assert Usual(program={}, referee={}).margin(broken, "stopped").value == 0


def test_parts_that_are_usually_used_up_are_left_out() -> None:
    rows = [row("right", {"rounds": 0, "search": places}, **checks()) for places in (30, 40, 50)]
    assert usual(rows) == Usual(program={"search": 40}, referee={"gap": pytest.approx(0.15), "force": 20})


def test_a_failing_world_is_reduced_to_the_deviations_that_it_needs() -> None:
    numbers = np.array([0.4, -1.9, 0.3, 1.6, -0.7, 0.2, 0.8, -0.1])
    tries, count = simplified(numbers, [range(5), range(5, 8)], 30), 0
    tried = next(tries)
    found = numbers
    while True:
        fails = bool(tried[1] < -1.0 and tried[3] > 0.9)
        found, count = tried if fails else found, count + 1
        try:
            tried = tries.send(fails)
        except StopIteration:
            break
    assert [*np.flatnonzero(found)] == [1, 3]
    assert abs(found[1]) < 1.3
    assert count <= 30


def test_no_more_runs_are_made_than_allowed() -> None:
    for most in (1, HALVINGS, 7):
        assert sum(1 for _ in simplified(np.ones(16), [range(16)], most)) == most
