"""The executable specification of the guarded move, and the machine beside it."""

import doctest
import re
from pathlib import Path
from typing import Final

import pytest
from drawn_programs import compared, first_difference
from run_bench import program

from handeye.systems.ml.guarded import Branch, Delay, Motion, Sensor, State, branch, execute

PAGE: Final = Path(__file__).parents[3] / "docs/guarded_moves.md"
SPEEDS = {2: 7874, 3: 7874}
START = State.at({2: 0, 3: 0})


def never(cycle, positions):  # type: ignore[no-untyped-def]
    return {5: 0}


def beyond(cycle, positions):  # type: ignore[no-untyped-def]
    return {5: 500 if positions[3] >= 1000 else 0}


@pytest.mark.slow
@pytest.mark.ml_row(58)
def test_specification_and_machine_agree_on_drawn_programs_statement_by_statement() -> None:
    for seed in range(300):
        assert first_difference(seed) is None


def test_the_drawn_programs_freeze_nullify_reach_goals_and_branch_both_ways() -> None:
    endings = {"": 0, "goal": 0, "force": 0, "nullified": 0}
    for seed in range(25):
        for _, said, _ in compared(seed):
            endings[said[1]] += 1  # type: ignore[index]
    assert min(endings.values()) > 9


def test_the_guarded_move_in_seven_lines() -> None:
    state, _ = execute(Sensor(sensor=5, limits=(-178, 450)), START, beyond, SPEEDS)
    state, ending = execute(Motion(by_motor={3: 4000}), state, beyond, SPEEDS)
    assert (ending, state.positions, state.goals) == ("force", {2: 0, 3: 1024}, {2: 0, 3: 1024})
    after, ending = execute(Motion(by_motor={2: -100}, relative=True), state, beyond, SPEEDS)
    assert (ending, after) == ("nullified", state)
    assert branch(Branch(then=500, other=410, sensors=(5,)), after.flags) == 500


def test_a_flag_outlives_the_reading_and_any_branch() -> None:
    state, _ = execute(Sensor(sensor=5, limits=(-1, 1)), START, never, SPEEDS)
    state, _ = execute(Delay(cycles=2), state, lambda cycle, _: {5: int(cycle == 1)}, SPEEDS)
    state, _ = execute(Delay(cycles=5), state, never, SPEEDS)
    assert state.flags == {5}
    assert branch(Branch(then=1, other=2), state.flags) == 1
    assert branch(Branch(then=1, other=2, sensors=(-5,)), state.flags) == 2
    assert branch(Branch(then=1), frozenset()) == 1


def test_specification_and_machine_share_no_code() -> None:
    from handeye.systems.ml import guarded

    with open(guarded.__file__, encoding="utf-8") as file:
        assert "handeye" not in [line.split()[1].split(".")[0] for line in file if line.startswith("from ")]


def test_the_page_on_guarded_moves_shows_what_is_so() -> None:
    text = PAGE.read_text(encoding="utf-8")
    blocks = re.findall(r"```pycon\n(.*?)```", text, re.DOTALL)
    test = doctest.DocTestParser().get_doctest("".join(blocks), {}, PAGE.name, None, 0)
    said: list[str] = []
    assert not doctest.DocTestRunner().run(test, out=said.append).failed, "".join(said)
    statements = re.search(r"```\n(200 SENSOR.*?)```", text, re.DOTALL)
    assert statements is not None
    assert statements[1] in program("guarded_move")
