"""The graph of steps against the plainest way of asking it."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from handeye.program.flow_operations import Countdown
from handeye.program.graph import Graph
from handeye.program.program import Step

GRAPHS = st.integers(1, 9).flatmap(
    lambda size: st.lists(
        st.tuples(*[st.none() | st.integers(0, size - 1)] * 2), min_size=size, max_size=size
    )
)
"""For each step, the two it leads to."""


def graph_of(ways: list[tuple[int | None, int | None]]) -> Graph:
    return Graph(
        [
            Step(operation=Countdown(counter="N", positive=other), stage=0, line=1, text="", next=next)
            for next, other in ways
        ]
    )


@given(GRAPHS)
def test_a_step_is_in_one_circle_with_all_that_come_before_and_after_it(
    ways: list[tuple[int | None, int | None]],
) -> None:
    graph = graph_of(ways)
    plainly = [{number} | (graph.after([number]) & graph.before([number])) for number in range(len(ways))]
    assert graph.circles() == plainly


@pytest.mark.slow
@given(GRAPHS, st.sets(st.integers(0, 8)))
def test_a_way_avoids_steps_as_if_they_led_nowhere(
    ways: list[tuple[int | None, int | None]], without: set[int]
) -> None:
    graph, cut = graph_of(ways), graph_of([(None, None) if n in without else w for n, w in enumerate(ways)])
    last = len(ways) - 1
    plainly = not without & {0, last} and last in {0} | cut.after([0])
    assert graph.leads(0, last, without) == plainly


@given(GRAPHS, st.sets(st.integers(0, 8)))
def test_trapped_is_what_leads_neither_to_the_end_nor_to_an_exit(
    ways: list[tuple[int | None, int | None]], exits: set[int]
) -> None:
    graph = graph_of(ways)
    out = {number for number in range(len(ways)) if number in exits or None in ways[number]}
    plainly = {n for n in range(len(ways)) if n not in out and not out & graph.after([n])}
    assert graph.trapped({number for number in exits if number < len(ways)}) == plainly
