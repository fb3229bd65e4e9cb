"""Programs of TRIG run forwards and backwards by an arm that is imagined, as far as no physics is needed."""

import pytest
from trig_sessions import BUCKET, PALLETISE, Typist, typed

from handeye.core.errors import InvalidInput
from handeye.systems.trig.language.command_input import hear
from handeye.systems.trig.language.no_arm import NoArm
from handeye.systems.trig.language.running import Interpreter, RunResult
from handeye.systems.trig.language.session import Session

SEVENTH = 100
"""Counted steps after which the seventh block is on its way."""


def palletiser(blocks: int) -> Typist:
    """The paper's second example as it was taught, with so many blocks on the stack."""
    typist = Typist(PALLETISE + "* CLEAR\n")
    if blocks:
        typist.type(f"* STACK {blocks} X 150 Y 0")
    typist.type("GOPOS CENTER")
    typist.told.clear()
    return typist


def placed(typist: Typist) -> int:
    """Blocks that are no longer on the stack."""
    return sum((x, y) != (150, 0) for x, y, _ in typist.blocks.values())


@pytest.mark.parametrize(
    ("blocks", "count", "steps"),
    [(20, 15, 227), (7, 7, None), (0, 0, 5)],
    ids=["20 blocks", "7 blocks", "none"],
)
def test_the_palletiser_places_what_there_is_and_takes_all_of_it_back(
    blocks: int, count: int, steps: int | None
) -> None:
    typist = palletiser(blocks)
    before = typist.blocks
    typist.type("RUN")
    assert (placed(typist), typist.at, typist.active.name) == (count, (0, 150, 200), "FINISH")
    places = [place for place in typist.blocks.values() if place[:2] != (150, 0)]
    assert len({*places}) == count
    assert typist.told[-1].endswith("the program has ended")
    assert steps is None or typist.told[-1].startswith(f"{steps} steps")
    typist.type("RUN -1000")
    assert (typist.blocks, typist.at) == (before, (0, 0, 270))
    pallet = typist.session.program.positions["PALLET"]
    assert pallet.data == pallet.init
    assert {step.count for step in typist.steps} == {0}


def test_every_run_places_alike() -> None:
    typist = palletiser(20)
    typist.type("RUN")
    first = typist.blocks
    typist.type("* CLEAR\n* STACK 20 X 150 Y 0\nRUN")
    assert set(typist.blocks.values()) == {*first.values()}


@pytest.mark.slow
def test_a_run_that_is_halted_after_any_number_of_steps_can_be_taken_back() -> None:
    session = typed(PALLETISE)
    arm = session.arm
    assert isinstance(arm, NoArm)
    hear(session, "GOPOS CENTER")
    before = list(arm.blocks)
    for steps in range(1, 228, 6):
        session.program.put_cursor(session.program.first)
        assert session.runner.forward(steps).steps == steps
        assert session.runner.back(1000) == RunResult(steps=steps, end="beginning")
        assert arm.held is None
        assert _rounded(arm) == [(b.name, round(b.x, 9), round(b.y, 9), round(b.z, 9)) for b in before]
        assert {node.count for node in session.program.graph.nodes.values()} == {0}


def _rounded(arm: NoArm) -> list[tuple[str, float, float, float]]:
    return [(block.name, round(block.x, 9), round(block.y, 9), round(block.z, 9)) for block in arm.blocks]


def test_every_step_back_restores_what_was_before_it() -> None:
    typist = palletiser(20)
    program, forward = typist.session.program, list[str]()

    def state() -> str:
        counts = [step.count for step in typist.steps if step.type == "loop"]
        place = [round(value, 9) for value in typist.arm.here()]
        return f"{counts} {program.positions['PALLET'].data} {typist.arm.closed} {place}"

    class Watched(Interpreter):
        """Notes the state whenever a step begins."""

        def _begin(self, id: int) -> bool:
            forward.append(state())
            return True

    runner = Watched(program=program, arm=typist.arm, halted=lambda: False, refresh=lambda: None)
    assert runner.run().steps == len(forward) == 227
    for before in reversed(forward):
        assert typist.session.runner.back(1).steps == 1
        assert state() == before


def test_a_run_that_is_halted_goes_on_as_if_it_had_not_been() -> None:
    straight = palletiser(20)
    straight.type("RUN")
    strikes = iter(n == SEVENTH for n in range(10_000))
    typist = palletiser(20)
    typist.halted = lambda: next(strikes)
    typist.type("RUN")
    assert "; stopped: RUN" in typist.told[-1]
    typist.halted = lambda: False
    typist.type("RUN 1000")
    assert (typist.blocks, typist.at) == (straight.blocks, straight.at)
    typist.type("RUN -1000")
    assert placed(typist) == 0


def test_the_first_example_carries_both_blocks_and_brings_them_back() -> None:
    taught, _, _ = BUCKET.partition("* CLEAR")  # blocks are where teaching has left them
    typist = Typist(taught + "RUN -1000\nRUN")
    assert typist.blocks == {"1": (140, 0, 156), "2": (-120, 60, 12)}
    assert (typist.at, typist.arm.closed) == ((0, 0, 150), False)
    typist.type("RUN -1000")
    assert typist.blocks == {"1": (-120, 60, 12), "2": (-120, -60, 12)}


def test_a_force_where_no_guarded_son_is_ends_the_program() -> None:
    typist = Typist(
        "M UP\nX 0 Y 0 Z 100 RECORD\nMG DOWN\nZ 5 RECORD\n2\n(0 0 1)\nGRASP\nn\n* STACK 2 X 0 Y 0\nRUN"
    )
    assert (typist.told[-1], typist.active.type) == ("2 steps done; the program has ended", "guarded")


class SlowArm(NoArm):
    """Stops half-way when it is told to."""

    def go(self, goal, halted):  # type: ignore[no-untyped-def] # as the one above it
        self.check_travel(goal)
        here = self.here()
        super().go(here._replace(x=(here.x + goal.x) / 2), lambda: False)
        if halted():
            return False
        return super().go(goal, lambda: False)


def test_a_relative_move_that_is_halted_on_its_way_ends_where_it_would_have() -> None:
    typist = Typist("MR STEP\nX BY 40 RECORD\nCN A\nLOOP A 4\nFREE\nX 0 RECORD\n")
    session = Session(
        arm=(arm := SlowArm()), table=arm, desk=typist.session.desk, program=typist.session.program
    )
    strikes = iter([False, False, False, False, True])
    runner = session.runner
    runner.halted = lambda: next(strikes, False)
    assert runner.run() == RunResult(steps=2, end="halted")
    assert (arm.here().measures()[0], session.program.active.name) == (60, "A")
    assert runner.forward(1000).end == "none"
    assert arm.here().measures()[0] == 200
    assert runner.back(1000) == RunResult(steps=10, end="beginning")
    assert arm.here().measures()[0] == 0


def test_a_run_that_is_halted_before_its_first_step_comes_round_again_goes_on_and_does_not_begin_anew() -> (
    None
):
    typist = Typist("MR DX\nX BY 20 RECORD\nCN A\nLOOP A 4\nFREE\nX 0 RECORD\n")
    strikes = iter([False, False, False, True])
    typist.halted = lambda: next(strikes, False)
    typist.type("RUN")
    assert (typist.at[0], typist.active.name) == (20, "A")
    typist.type("RUN 1000")
    assert typist.at[0] == 100


def test_a_relative_loop_comes_back_to_where_it_began() -> None:
    typist = Typist("MR DX\nX BY 20 RECORD\nCN A\nLOOP A 4\nFREE\nX 0 RECORD\nRUN")
    assert typist.at[0] == 100
    typist.type("RUN -1000")
    assert typist.at[0] == 0


AFTER_LINE_7 = PALLETISE[: PALLETISE.index("* STACK")] + "* STACK 20 X 150 Y 0\n"


@pytest.mark.parametrize(
    ("lines", "touches"),
    [
        ("GOTO GET-BLOCK\nRUN 3", True),
        ("GOPOS STACK\nP\nRUN 1", True),
        ("RUN -2\nRUN 2", True),
        ("RUN -1\nRUN 1", False),
    ],
)
def test_ways_back_to_the_guarded_step_after_line_7(lines: str, touches: bool) -> None:
    """The last pair stands in the paper, and leads to the bottom of the stack, where there is nothing to be met."""
    typist = Typist(AFTER_LINE_7 + lines)
    assert typist.active.type == "guarded"
    assert typist.at == (150, 0, 240 if touches else 2)


def test_a_step_that_the_arm_cannot_do_stops_the_run_there() -> None:
    typist = Typist("MR DX\nX BY 90 RECORD\nCN A\nLOOP A 4\nFREE\nX 0 RECORD\n")
    with pytest.raises(InvalidInput, match=r"^X would be 270 mm; its range is -200 to 200 mm$"):
        typist.type("RUN")
    assert (typist.active.name, typist.at[0]) == ("A", 180)
    typist.type("RUN -1000")
    assert typist.at[0] == 0


def test_what_was_taught_can_be_undone_at_once() -> None:
    typist = Typist("M A\nX 10 RECORD\nGRASP\nM B\nX 30 RECORD\nRUN -1")
    assert (typist.at[0], typist.active.type, typist.arm.closed) == (10, "grasp", True)
    typist.type("RUN -5")
    assert (typist.at[0], typist.arm.closed) == (0, False)


def test_undoing_a_grasp_of_a_closed_hand_leaves_it_closed() -> None:
    typist = Typist("GOGRASP\nM A\nX 10 RECORD\nGRASP\nRUN -1")
    assert typist.arm.closed


def test_only_so_much_is_remembered_and_it_is_told(monkeypatch: pytest.MonkeyPatch) -> None:
    typist = Typist("MR DX\nX BY 1 RECORD\nCN A\nLOOP A 40\nFREE\nX 0 RECORD\n")
    typist.session.program.trail = type(typist.session.program.trail)(maxlen=10)
    typist.type("RUN\nRUN -1000")
    assert typist.told[-1].endswith("earlier steps are no longer recorded")
    assert typist.at[0] > 0
