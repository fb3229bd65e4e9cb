"""Worlds drawn by name: what a seed, a level and overrides decide, and what they leave alone."""

import msgspec
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from handeye.core.distributions import Distribution, Fixed, Noise, Normal, Phase, Range, Step, Uniform
from handeye.core.errors import InvalidInput
from handeye.core.units import DEGREE, INCH
from handeye.core.variation import (
    DRAWING,
    UNSOURCED,
    Level,
    Overrides,
    Quantity,
    Variation,
    World,
    WorldSpec,
)


def quantity(name: str, distribution: Distribution, unit: str = "in", nominal: float = 0.0) -> Quantity:
    return Quantity(name=name, unit=unit, distribution=distribution, nominal=nominal, source="a test")


TABLE = Variation(
    quantity("camera.place.x", Normal(0.15)),
    quantity("camera.place.y", Normal(0.15)),
    quantity("camera.turn", Uniform(0.2), "deg"),
    quantity("camera.noise", Noise(0.07), "deg"),
    quantity("slip", Uniform(1.0), nominal=2.0),
    quantity("wave", Fixed(0.03)),
    quantity("step", Step(0.01)),
    quantity("start", Phase(), "deg"),
    quantity("belt", Range(41.5, 47.5), nominal=44.5),
)

NAMES = st.sampled_from(sorted({*TABLE.quantities, *TABLE.groups}))
SEEDS = st.integers(0, 2**40)


def drawn(
    seed: int, level: Level = "nominal", without: tuple[str, ...] = (), values: dict[str, float] | None = None
) -> World:
    return TABLE.draw(
        WorldSpec(seed=seed, level=level, overrides=Overrides(without=without, set=values or {}))
    )


def differing(one: World, other: World) -> set[str]:
    return {name for name in one.values if one[name] != other[name]}


@given(SEEDS)
def test_equal_specifications_give_equal_worlds(seed: int) -> None:
    assert drawn(seed) == drawn(seed)


def test_different_seeds_give_different_worlds() -> None:
    assert differing(drawn(7), drawn(8)) == TABLE.quantities.keys() - {"camera.noise", "wave", "step"}


@given(SEEDS)
def test_a_new_name_moves_no_other_draw(seed: int) -> None:
    longer = Variation(quantity("fixtures.new", Normal(1.0)), *TABLE.quantities.values())
    world = longer.draw(WorldSpec(seed=seed))
    assert {name: world[name] for name in TABLE.quantities} == drawn(seed).values


@given(SEEDS, NAMES)
def test_without_a_name_nothing_else_changes(seed: int, name: str) -> None:
    changed = differing(drawn(seed), drawn(seed, without=(name,)))
    assert changed <= {q.name for q in TABLE.select(name)}


@given(SEEDS, NAMES)
def test_without_a_name_it_has_its_nominal_value(seed: int, name: str) -> None:
    world = drawn(seed, "high", without=(name,))
    assert all(world[q.name] == q.nominal * q.measure.size for q in TABLE.select(name))


@given(SEEDS)
def test_a_value_that_is_set_changes_nothing_else(seed: int) -> None:
    world = drawn(seed, values={"camera.place.x": 0.01})
    assert (world["camera.place.x"], differing(drawn(seed), world)) == (0.01, {"camera.place.x"})


def test_what_is_set_counts_for_more_than_what_is_left_out() -> None:
    world = drawn(1, without=("camera",), values={"camera.place.x": 0.01})
    assert (world["camera.place.x"], world["camera.place.y"]) == (0.01, 0.0)


def test_a_level_does_not_touch_what_is_set() -> None:
    assert drawn(1, "high", values={"slip": 0.01})["slip"] == 0.01


@given(SEEDS)
def test_the_high_level_doubles_every_error_and_the_low_one_halves_it(seed: int) -> None:
    low, usual, high = (drawn(seed, level) for level in ("low", "nominal", "high"))
    for name in ("camera.place.x", "camera.place.y", "camera.turn", "camera.noise", "slip", "wave"):
        nominal = TABLE.quantities[name].nominal * INCH
        assert high[name] - nominal == pytest.approx(2 * (usual[name] - nominal))
        assert low[name] - nominal == pytest.approx((usual[name] - nominal) / 2)


@given(SEEDS)
def test_levels_leave_alone_what_is_no_error(seed: int) -> None:
    assert not {"belt", "start", "step"} & differing(drawn(seed, "low"), drawn(seed, "high"))


def test_values_are_si() -> None:
    world = drawn(3)
    assert world["wave"] == 0.03 * INCH
    assert 41.5 * INCH <= world["belt"] <= 47.5 * INCH
    assert 0 <= world["start"] <= 360 * DEGREE


@pytest.mark.parametrize(
    ("name", "nominal", "most"),
    [("camera.place.x", 0.0, 0.30), ("slip", 2.0, 1.0)],
)
def test_draws_reach_their_spread_and_never_go_beyond(name: str, nominal: float, most: float) -> None:
    off = np.abs([drawn(seed)[name] / INCH - nominal for seed in range(300)])
    assert 0.95 * most < off.max() <= most + 1e-12


def test_a_normal_quantity_has_the_sigma_it_says() -> None:
    values = [drawn(seed)["camera.place.y"] / INCH for seed in range(2000)]
    assert np.std(values) == pytest.approx(0.15 * 0.96, rel=0.05)  # clipping takes some of it
    assert np.mean(values) == pytest.approx(0.0, abs=0.01)


def test_two_quantities_of_a_world_are_independent() -> None:
    pairs = [(drawn(seed)["camera.place.x"], drawn(seed)["camera.place.y"]) for seed in range(1000)]
    assert abs(np.corrcoef(np.array(pairs).T)[0, 1]) < 0.1


def test_streams_of_noise_are_independent_and_repeat() -> None:
    world = drawn(1)
    assert world.generator("sensors").random() == drawn(1, "high").generator("sensors").random()
    assert world.generator("sensors").random() != world.generator("camera").random()


@given(SEEDS, st.sampled_from(["low", "nominal", "high"]), NAMES)
def test_a_specification_survives_the_disk(seed: int, level: Level, name: str) -> None:
    spec = WorldSpec(seed=seed, level=level, overrides=Overrides(without=(name,), set={"belt": 0.1}))
    assert msgspec.json.decode(msgspec.json.encode(spec), type=WorldSpec) == spec


def test_a_world_drawn_in_another_way_is_refused() -> None:
    sentence = (
        "the world of seed 3 comes from another version of handeye; this version makes a different world from "
        "that seed"
    )
    with pytest.raises(InvalidInput, match=sentence):
        TABLE.draw(WorldSpec(seed=3, drawing=DRAWING + 1))


@pytest.mark.parametrize(
    ("overrides", "sentence"),
    [
        (
            Overrides(without=("cammera",)),
            "the world has no quantity `cammera`; did you mean `camera`?",
        ),
        (
            Overrides(set={"x": 1.0}),
            "the world has no quantity `x`; choose from `camera`, `slip`, `wave`",
        ),
        (
            Overrides(set={"camera": 1.0}),
            "`camera` is a group of quantities; set each quantity by its own name",
        ),
    ],
)
def test_overrides_that_the_task_does_not_know_are_refused(overrides: Overrides, sentence: str) -> None:
    with pytest.raises(InvalidInput) as refused:
        TABLE.draw(WorldSpec(seed=0, overrides=overrides))
    assert str(refused.value).startswith(sentence)


def test_a_group_is_a_name_before_a_dot_and_no_mere_beginning() -> None:
    assert [q.name for q in TABLE.select("camera.place")] == ["camera.place.x", "camera.place.y"]
    with pytest.raises(InvalidInput):
        TABLE.select("camera.pl")


@pytest.mark.parametrize("value", [float("nan"), float("inf"), 1e9, "1", True])
def test_a_value_that_a_quantity_cannot_have_is_refused_wherever_it_comes_from(value: float) -> None:
    bounded = Variation(
        Quantity(name="x", unit="in", distribution=Normal(1.0), limits=(-5, 5), source="test")
    )
    with pytest.raises(InvalidInput, match=r"^x must be between "):
        bounded.draw(WorldSpec(seed=1, overrides=Overrides(set={"x": value})))


def test_a_level_that_there_is_none_of_is_refused() -> None:
    with pytest.raises(InvalidInput, match="there is no level 'foo'; the levels are low, nominal, high"):
        TABLE.draw(WorldSpec(seed=1, level="foo"))  # type: ignore[arg-type]


GUESSED = Variation(
    *TABLE.quantities.values(),
    Quantity(name="guess", unit="in", distribution=Normal(1.0), source="a test", unsourced="unknown"),
)


def scaled(seed: int, level: Level = "nominal", **scale: float) -> World:
    names = {name.replace("_", "."): factor for name, factor in scale.items()}
    return GUESSED.draw(WorldSpec(seed=seed, level=level, overrides=Overrides(scale=names)))


@given(SEEDS)
def test_a_scale_changes_the_size_of_its_errors_and_nothing_else(seed: int) -> None:
    once, twice = scaled(seed), scaled(seed, unsourced=2.0)
    assert differing(once, twice) == {"guess"}
    assert twice["guess"] == pytest.approx(2 * once["guess"])


@given(SEEDS)
def test_of_two_scales_the_narrower_one_counts(seed: int) -> None:
    once, both = scaled(seed), scaled(seed, camera=3.0, camera_place=0.5, guess=1.0, unsourced=4.0)
    assert both["camera.place.x"] == pytest.approx(once["camera.place.x"] / 2)
    assert both["camera.turn"] == pytest.approx(3 * once["camera.turn"])
    assert both["guess"] == once["guess"]


@given(SEEDS)
def test_a_scale_of_two_is_the_high_level_of_what_it_names(seed: int) -> None:
    assert scaled(seed, camera=2.0)["camera.turn"] == drawn(seed, "high")["camera.turn"]


@pytest.mark.parametrize("factor", [-1.0, 4.1, float("nan"), float("inf"), "2", True])
def test_a_factor_that_errors_cannot_have_is_refused(factor: float) -> None:
    with pytest.raises(InvalidInput, match=r"^`slip` cannot be scaled by "):
        scaled(1, slip=factor)
    with pytest.raises(InvalidInput, match=r"at the level high, a factor must be between 0 and 2$"):
        scaled(1, "high", slip=2.5)


@pytest.mark.parametrize("name", ["belt", "step", "start"])
def test_what_is_no_error_cannot_be_scaled(name: str) -> None:
    with pytest.raises(
        InvalidInput, match=f"^there is nothing to scale: the world has no error in `{name}`$"
    ):
        scaled(1, **{name: 2.0})


def test_where_all_sizes_have_sources_none_can_be_scaled_for_having_none() -> None:
    with pytest.raises(InvalidInput, match=r"^there is nothing to scale: the world has no unsourced error$"):
        TABLE.draw(WorldSpec(seed=1, overrides=Overrides(scale={UNSOURCED: 2.0})))
