"""What operations tell of themselves is enough to walk, check and carry out any program."""

import ast
from pathlib import Path
from typing import get_args

import pytest

from handeye.execution.executor import ACTIONS
from handeye.execution.flow_actions import DECISIONS
from handeye.program import operation
from handeye.program.flow_operations import Countdown, Jump, Test
from handeye.program.guards import AnyGuard, GuardKind
from handeye.program.motion_operations import Change, Move, Restore
from handeye.program.operation import Operation
from handeye.program.operations import AnyOperation

OPERATIONS: tuple[type[Operation], ...] = get_args(AnyOperation)


def test_every_operation_has_one_action_and_the_branching_ones_a_decision() -> None:
    assert {*ACTIONS} | {*DECISIONS} == {*OPERATIONS}
    assert {*DECISIONS} == {operation for operation in OPERATIONS if operation.branches}


@pytest.mark.parametrize("operation", OPERATIONS)
def test_what_an_operation_tells_of_its_fields_is_about_fields_it_has(operation: type[Operation]) -> None:
    fields = set(operation.__struct_fields__)
    named = {
        name for table in (operation.reading, operation.writing) for names in table.values() for name in names
    }
    assert named | {*operation.bounds} | {*operation.choices} <= fields


def asked_for(text: str) -> set[str]:
    """The operations by whose class a module asks: with `isinstance`, `case`, or a comparison of types."""
    nodes = [*ast.walk(ast.parse(text))]
    known = {
        alias.asname or alias.name: alias.name
        for node in nodes
        if isinstance(node, ast.ImportFrom) and (node.module or "").endswith("_operations")
        for alias in node.names
    }
    asked: list[ast.AST] = [node.cls for node in nodes if isinstance(node, ast.MatchClass)]
    asked += [node for node in nodes if isinstance(node, ast.Compare) and "type(" in ast.unparse(node)]
    for node in nodes:
        if isinstance(node, ast.Call) and ast.unparse(node.func) in ("isinstance", "issubclass"):
            asked.append(node.args[1])
    named = {part.id for one in asked for part in ast.walk(one) if isinstance(part, ast.Name)}
    return {known[name] for name in named & known.keys()} & {kind.__name__ for kind in OPERATIONS}


@pytest.mark.parametrize(
    "line",
    [
        "isinstance(o, Move)",
        "isinstance(o, (str, Move))",
        "isinstance(o, str | Go)",
        "type(o) is Move",
        "type(o) in (Move,)",
    ],
)
def test_a_module_is_seen_to_ask_for_a_class_however_it_asks(line: str) -> None:
    begun = "from handeye.program.motion_operations import Move, Move as Go\n"
    assert asked_for(begun + line) == {"Move"}


@pytest.mark.slow
def test_an_operation_is_asked_for_its_class_only_where_its_meaning_is_given() -> None:
    package = Path(operation.__file__).parents[1]
    found = {str(path.relative_to(package)) for path in package.rglob("*.py") if asked_for(path.read_text())}
    assert found == {
        "al/lower.py",  # where a RESTORE finds its MOVE, and a search its own
        "proof/evidence.py",  # what a step shows, as the next
        "proof/hand_places.py",
        "proof/outcomes.py",  # how a step can end, as the next
        "proof/ways.py",
        "systems/stanford/leg.py",  # what a leg of this language finds and holds
        "systems/relay/check.py",  # what a leg needs from the legs before it
        "trials/mutants/purpose.py",  # what a check is for
        "trials/mutants/rules.py",  # what a mutant lacks
        "planning/grasp_state.py",  # where the planner opens and closes the hand
        "planning/motion_checks.py",  # where it puts a load into it
        "trials/rare/reserves.py",  # what the program has left of its searches and checks
        "trials/plans/row.py",  # where trials count the operations in which parts touch
    }


def test_every_guard_is_called_on_disk_as_its_kind() -> None:
    guards = get_args(AnyGuard)
    assert [guard.kind for guard in guards] == list(GuardKind)
    assert [guard.__struct_config__.tag for guard in guards] == list(GuardKind)


def test_a_move_reads_its_positions_and_what_shifts_it() -> None:
    move = Move(goal="T", via=("A",), restore=(Restore(name="D", level=True),), searching=True)
    assert [tuple(use) for use in move.reads] == [
        ("position", "T", False),
        ("position", "A", False),
        ("difference", "D", True),
        ("search", "", False),
    ]


def test_a_branch_tells_when_it_is_gone_and_can_be_led_elsewhere() -> None:
    assert Test(number=23, raised=4).branch == (4, 23, None)
    assert Countdown(counter="N", positive=4).leading_to(9).branch == (9, None, "N")
    assert Jump().branch is None


def test_a_change_is_meant_to_meet_what_it_presses_on() -> None:
    free = Change(displacement=(0, 0, 1), free=(1, 0, 0))
    assert (free.complies, free.meets) == (True, False)
    assert Change(displacement=(0, 0, 1), press=(0, 0, -1)).meets
