"""The graph of a TRIG program: cursor, links, deletion, and the worked example."""

import pytest
from trig_sessions import PALLETISE, Typist, straight

from handeye.core.errors import InvalidInput
from handeye.systems.trig.language.graph import GUARDED, NONE, NORMAL
from handeye.systems.trig.language.storage import encoded, faults

FORK = """M UP
Z 100 RECORD
MG DOWN
Z 5 RECORD
2
(0 0 1)
CN G1
M LEFT n
X -50 RECORD
CN NORMAL-SON
GOTO G1
M RIGHT g
X 50 RECORD
CN GUARDED-SON
"""


@pytest.mark.trig_row(15)
def test_the_cursor_goes_to_named_steps_only() -> None:
    typist = Typist(straight(2) + "\nM P3\nX 3 RECORD\n")
    with pytest.raises(InvalidInput, match=r"^there is no step `P3`; did you mean `S1`\?|known: `S1`, `S2`$"):
        typist.type("GOTO P3")
    assert typist.active.position == "P3"


@pytest.mark.trig_row(16)
def test_the_cursor_asks_on_the_way_down_and_remembers_on_the_way_up() -> None:
    typist = Typist(FORK + "GOTO G1\nN\ng")
    assert typist.active.name == "GUARDED-SON"
    typist.type("P\nN\nn")
    assert typist.active.name == "NORMAL-SON"
    palletiser = Typist(PALLETISE)
    palletiser.type("N")
    assert palletiser.active.name == "FINISH"
    palletiser.type("P")
    assert palletiser.active.type == "loop"
    linked = Typist(PALLETISE + "GOTO FINISH\nP")
    assert linked.active.type == "loop"
    palletiser.type("* CLEAR\nRUN")
    assert palletiser.active.name == "FINISH"
    palletiser.type("P")
    assert palletiser.active.type == "guarded"


@pytest.mark.trig_row(17)
def test_deleting_a_step_closes_the_gap_and_of_a_guarded_one_keeps_a_branch() -> None:
    typist = Typist(straight(5) + "\nD S3")
    assert (typist.names, typist.active.name) == (["S1", "S2", "S4", "S5"], "S2")
    fork = Typist(FORK + "D G1 g")
    assert fork.names == ["normal", "GUARDED-SON"]
    asked = Typist(FORK + "D G1\nn")
    assert asked.names == ["normal", "NORMAL-SON"]


@pytest.mark.trig_row(18)
def test_deleting_all_leaves_what_can_be_reached_otherwise() -> None:
    assert Typist(straight(6) + "\nDA S3").names == ["S1", "S2"]
    linked = Typist(
        FORK + "M A\nX 1 RECORD\nCN S5\nM B\nX 2 RECORD\nCN S6\nGOTO NORMAL-SON\nL S5\nDA GUARDED-SON"
    )
    assert linked.names == ["normal", "G1", "NORMAL-SON", "S5", "S6"]
    assert linked.step("S5").fathers == [linked.step("NORMAL-SON").id]
    assert linked.step("NORMAL-SON").links == set()


@pytest.mark.trig_row(19)
def test_unlinking_leaves_the_step_to_its_other_fathers() -> None:
    typist = Typist(PALLETISE + "DLINK FINISH")
    assert typist.active.sons == [NONE]
    assert [typist.session.program.graph[father].type for father in typist.step("FINISH").fathers] == [
        "guarded"
    ]
    with pytest.raises(InvalidInput, match=r"^no other step leads to S2; to delete S2, use `DA S2`$"):
        Typist(straight(2) + "\nGOTO S1\nDLINK S2")


@pytest.mark.trig_row(24)
def test_the_26_lines_of_the_paper_make_its_graph() -> None:
    typist = Typist(PALLETISE)
    graph = typist.session.program.graph
    chain = [graph[id].type for id in graph.order()]
    assert chain == [
        "top", "normal", "bloop", "bloop", "normal", "grasp", "guarded", "normal", "normal", "ungrasp", "normal",
        "grasp", "normal", "normal", "ungrasp", "normal", "normal", "savpos", "loop", "normal", "savpos", "loop",
    ]  # fmt: skip
    outer, inner = (node for node in graph.nodes.values() if node.type == "bloop")
    inner, outer = sorted((inner, outer), key=lambda bloop: graph[bloop.partner].wanted)
    assert (graph[inner.partner].wanted, graph[outer.partner].wanted, outer.sons) == (2, 4, [inner.id])
    guarded = next(step for step in typist.steps if step.type == "guarded")
    assert graph[guarded.sons[NORMAL]].name == "FINISH"
    assert graph[guarded.sons[GUARDED]].position == "RAISE"
    last = graph[outer.partner]
    assert (last.sons, last.links) == ([typist.step("FINISH").id], {NORMAL})
    kinds = {name: position.relative for name, position in typist.session.program.positions.items()}
    assert {name for name, relative in kinds.items() if relative} == {
        "RAISE",
        "LOWER",
        "PLACE",
        "NEXT-ROW",
        "NEWROW",
    }


@pytest.mark.trig_row(29)
def test_a_loop_that_was_forgotten_is_put_in_later() -> None:
    forgetful = Typist(PALLETISE.replace(">LOOP GET-BLOCK 2\n", "") + "GOTO RECALC1\nLOOP GET-BLOCK 2\n")
    assert encoded(forgetful.session.program) == encoded(Typist(PALLETISE).session.program)


@pytest.mark.trig_row(39)
def test_editing_leaves_the_trail_and_what_was_deleted_cannot_be_undone() -> None:
    typist = Typist(straight(3))
    before = list(typist.session.program.trail)
    assert [place.x for place in typist.session.program.pstack(typist.active.id)] == [0.002]
    typist.type("CN OTHER\nCP P1\nD S2")
    assert list(typist.session.program.trail) == before
    typist.type("RUN -1000")
    assert typist.told == ["1 step undone; the next earlier step has been deleted and cannot be undone"]


def test_a_step_that_is_reached_by_one_father_only_is_not_unlinked_from_it() -> None:
    typist = Typist(straight(3) + "\nL S2\nGOTO S1")
    with pytest.raises(
        InvalidInput,
        match=r"^S2 can be reached from the top only through this step; to delete S2, use `DA S2`$",
    ):
        typist.type("DLINK S2")
    assert typist.names == ["S1", "S2", "S3"]


def test_a_link_makes_its_step_the_most_recent_father() -> None:
    typist = Typist(straight(3) + "\nGOTO S1\nN\nGOTO S3\nL S2\nGOTO S2\nP")
    assert typist.active.name == "S3"


def test_nothing_is_put_below_a_link() -> None:
    typist = Typist(PALLETISE)
    with pytest.raises(
        InvalidInput, match=r"^a link leads from here to FINISH; remove the link first with `DLINK FINISH`$"
    ):
        typist.type("GRASP")


def test_a_loop_that_a_link_cuts_from_its_bloop_goes_and_the_cursor_stays_above() -> None:
    typist = Typist(straight(3))
    typist.type("L S1\nGOTO S1\nLOOP S2 2\nL S1\nYes")
    assert (typist.names, typist.active.name) == (["S1"], "S1")
    assert typist.active.sons == [typist.active.id]


def test_a_link_replaces_what_follows_where_somebody_agrees() -> None:
    typist = Typist(straight(4) + "\nGOTO S2\nL S4\nNo")
    assert typist.names == ["S1", "S2", "S3", "S4"]
    typist.type("L S4\nYes")
    assert typist.names == ["S1", "S2", "S4"]


def test_a_step_that_others_lead_to_stays_where_it_is_drawn_when_one_of_them_goes() -> None:
    typist = Typist(FORK + "GOTO NORMAL-SON\nL GUARDED-SON\nD NORMAL-SON")
    guarded = typist.step("G1")
    assert (guarded.sons, guarded.links) == ([typist.step("GUARDED-SON").id] * 2, {NORMAL})


def test_a_step_that_only_its_own_links_lead_to_goes_with_its_father() -> None:
    typist = Typist(straight(4) + "\nL S2\nDA S2")
    assert typist.names == ["S1"]


def test_steps_of_a_cycle_stay_whole_when_the_way_into_it_changes() -> None:
    typist = Typist(
        FORK + "M A\nX 1 RECORD\nCN A\nM B\nX 2 RECORD\nCN B\nL A\nGOTO NORMAL-SON\nL B\nDA GUARDED-SON"
    )
    assert typist.names == ["normal", "G1", "NORMAL-SON", "B", "A"]
    assert list(faults(typist.session.program.graph, typist.session.program.positions)) == []


@pytest.mark.slow
def test_ten_thousand_steps_are_typed_and_deleted() -> None:
    typist = Typist()
    graph = typist.session.program.graph
    for _ in range(10_000):
        graph.insert(typist.session.program.cursor, NORMAL, node := graph.new("grasp"))
        typist.session.program.put_cursor(node.id)
    typist.type("P 9999\nCN FIRST\nN 20000\nRUN\nRUN -10000\nGOTO FIRST\nDA")
    assert typist.told[-2:] == ["10000 steps done; the program has ended", "10000 steps undone"]
    assert typist.steps == []
