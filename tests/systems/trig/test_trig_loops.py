"""Loops of a TRIG program: how often they go, whichever was made first, and back."""

import pytest
from trig_sessions import Typist, straight

from handeye.core.errors import InvalidInput
from handeye.core.record import Vector3
from handeye.systems.trig.language.no_arm import NoArm
from handeye.systems.trig.language.place import Place
from handeye.systems.trig.language.trig_arm import Arrival, Halted

FIGURE_22 = "M A\nX 1 RECORD\nM B\nY 1 RECORD\nCN LOC1\nM D\nY 2 RECORD\nCN D\n"
INNER_FIRST = FIGURE_22 + "LOOP LOC1 2\nM F\nY 3 RECORD\nLOOP LOC1 3\n"
OUTER_FIRST = FIGURE_22 + "M F\nY 3 RECORD\nLOOP LOC1 3\nGOTO D\nLOOP LOC1 2\n"


def visits(typist: Typist) -> dict[str, int]:
    """How often each named step is done in a run from the top."""
    typist.type("RUN")
    done = [typist.session.program.graph[step.node].name for step in typist.session.program.trail]
    return {name: done.count(name) for name in done if name}


@pytest.mark.trig_row(20)
@pytest.mark.parametrize(("wanted", "times"), [(3, 4), (0, 1)])
def test_a_loop_does_its_body_once_more_than_it_goes_back(wanted: int, times: int) -> None:
    typist = Typist(straight(2) + f"\nLOOP S2 {wanted}")
    assert visits(typist) == {"S1": 1, "S2": times}


@pytest.mark.trig_row(21)
@pytest.mark.parametrize("text", [INNER_FIRST, OUTER_FIRST], ids=["inner first", "outer first"])
def test_loops_to_one_step_are_nested_whichever_was_made_first(text: str) -> None:
    typist = Typist(text)
    graph = typist.session.program.graph
    assert [graph[id].type for id in graph.order()] == [
        "top", "normal", "bloop", "bloop", "normal", "normal", "loop", "normal", "loop"
    ]  # fmt: skip
    outer, inner = (graph[id] for id in graph.order() if graph[id].type == "bloop")
    assert (graph[outer.partner].wanted, graph[inner.partner].wanted) == (3, 2)
    assert visits(typist) == {"LOC1": 12, "D": 12}


class TrippedArm(NoArm):
    """Meets a force at its third guarded move, and at no other."""

    felt = 0

    def feel(self, goal: Place, vector: Vector3, threshold: float, halted: Halted) -> Arrival:
        self.felt += 1
        return Arrival(kind="tripped" if self.felt == 3 else "reached")


@pytest.mark.trig_row(23)
def test_an_inner_loop_that_was_left_by_a_link_begins_anew() -> None:
    typist = Typist(
        "M IN\nX 1 RECORD\nCN IN\nMG DOWN\nZ 5 RECORD\n2\n(0 0 1)\nCN G1\nM LOW n\nZ 9 RECORD\nLOOP G1 5\n"
        "M OUT\nX 2 RECORD\nCN OUT\nLOOP IN 1\nGOTO G1\nL OUT g\n"
    )
    typist.session.arm = TrippedArm()
    assert visits(typist) == {"IN": 2, "G1": 3 + 6, "OUT": 2}


def test_a_loop_goes_back_and_not_on() -> None:
    typist = Typist(straight(3) + "\nGOTO S1")
    with pytest.raises(InvalidInput, match=r"^S3 is not above the active step, and a loop must go back"):
        typist.type("LOOP S3 2")


def test_the_target_of_a_loop_that_is_deleted_leaves_the_next_step_in_its_place() -> None:
    typist = Typist(straight(3) + "\nLOOP S2 1\nD S2")
    loop = typist.steps[-1]
    target = typist.session.program.graph.target(loop)
    assert (typist.names, target and target.name) == (["S1", "S3", "loop"], "S3")
    typist.type("D S3\nRUN")
    assert "the program has ended" in typist.told[-1]


def test_a_loop_takes_its_partner_along() -> None:
    typist = Typist(straight(2) + "\nLOOP S1 4\nD")
    graph = typist.session.program.graph
    assert [graph[id].type for id in graph.order()] == ["top", "normal", "normal"]


def test_a_million_rounds_are_halted_and_undone_as_far_as_they_are_remembered() -> None:
    rounds = 0

    def halted() -> bool:
        nonlocal rounds
        rounds += 1
        return rounds == 500

    typist = Typist("GRASP\nCN A\nLOOP A 1000000", halted)
    typist.type("RUN")
    assert typist.told[-1].startswith("499 steps done; stopped")
    typist.type("RUN -1000")
    assert typist.told[-1] == "499 steps undone; no earlier steps can be undone"
    assert typist.steps[-1].count == 0
