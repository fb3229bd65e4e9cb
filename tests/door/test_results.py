"""Results of many runs are a table in the order of their worlds."""

import pytest

import handeye
from handeye.errors import InvalidInput

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


def test_processes_give_the_same_results(results: list[handeye.Result]) -> None:
    again = handeye.trials.assemble_each([4, 1], script="OPEN 1\n", camera="ray", jobs=2)
    assert [each.referee for each in again][:1] == [each.referee for each in results][:1]


@pytest.mark.parametrize(
    ("words", "sentence"),
    [
        ({"worlds": ["3"]}, r"^a world is a seed or a handeye\.World, not '3'$"),
        ({"worlds": [-1]}, r"^a seed is a whole number from 0 up; -1 is not$"),
        ({"worlds": 3}, r"^worlds are seeds or worlds one after the other, not 3$"),
        ({"worlds": [1], "jobs": 0}, r"^jobs are a whole number from 1 up, not 0$"),
    ],
)
def test_what_cannot_be_tried_is_told_in_one_sentence(words: dict[str, object], sentence: str) -> None:
    with pytest.raises(InvalidInput, match=sentence):
        handeye.trials.assemble_each(script="OPEN 1\n", **words)
