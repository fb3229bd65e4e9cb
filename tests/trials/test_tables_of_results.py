"""Results of many runs are a table in the order of their worlds."""

import pytest

import handeye
from handeye.core.errors import InvalidInput
from handeye.touch.spiral import spiral

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def results() -> object:
    return handeye.trials.assemble_each([4, handeye.World(1, level="low")], script="OPEN 1\n", camera="ray")


def test_results_are_in_the_order_of_their_worlds(results: list[handeye.Result]) -> None:
    assert [(each.seed, each.world.level) for each in results] == [(4, "nominal"), (1, "low")]
    assert [each.seed for each in results[1:]] == [1]


def test_a_table_tells_the_verdict_on_each(results: list[handeye.Result]) -> None:
    head, first, second, count = repr(results).splitlines()
    assert head.split() == ["world", "verdict", "working", "phase"]
    assert (first.split("  ")[0], second.split("  ")[0]) == ("seed 4", "seed 1, level low")
    assert "not right" in first
    assert first.endswith(" more")
    assert count == "0 of 2 assembled"
    assert results._repr_html_().count("<tr>") == 3


def test_processes_give_the_same_results_against_other_limits(results: list[handeye.Result]) -> None:
    limits = {"floor": 99}
    again = handeye.trials.assemble_each([4, 1], script="OPEN 1\n", camera="ray", referee=limits, jobs=2)
    expected = results[0].referee | {"floor": results[0].referee["floor"].limited(99)}
    assert (again[0].referee, again[0].limits) == (expected, limits)


def test_trials_have_what_is_taught_and_a_search_and_a_referee_of_their_own() -> None:
    script, taught = "SEARCH .1\nL: MOVE P\nAOJ L\n", "[positions]\nP = { at = [25, 38, 6, 90, 90, 0] }\n"
    (result,) = handeye.trials.assemble_each(
        [3], script=script, taught=taught, camera="ray", search={0: (0, 0)}.get, referee=lambda truth: {}
    )
    assert (result.error, [*result.replaced]) == (6, ["search", "referee"])


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ({"worlds": ["3"]}, r"^a world must be a seed or a handeye\.World, not '3'$"),
        ({"worlds": [-1]}, r"^a seed must be a whole number from 0 to .*, not -1$"),
        ({"worlds": 3}, r"^worlds must be a sequence of seeds or worlds, not 3$"),
        (
            {"worlds": [1], "jobs": 2, "search": spiral},
            r"^code that replaces a part of the run needs one process: leave ",
        ),
        ({"worlds": [1], "referee": {"pump": 1}}, r"^the referee has no finding `pump`; "),
        ({"worlds": [1], "jobs": 0}, r"^jobs must be a whole number of 1 or more, not 0$"),
    ],
)
def test_what_cannot_be_tried_is_told_in_one_sentence(words: dict[str, object], sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        handeye.trials.assemble_each(script="OPEN 1\n", **words)


def test_the_table_of_results_has_a_row_a_world_and_a_column_a_finding(results: object) -> None:
    table = results.table()
    assert table["seed"].tolist() == [4, 1]
    assert table["world"] == ("seed 4", "seed 1, level low")
    assert table["verdict"] == ("not right", "not right")
    assert table["screws"].tolist() == [0.0, 0.0]
    assert {*results[0].referee} <= {column.name for column in table.columns}
