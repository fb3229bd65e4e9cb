"""Every error number is explained: what raises it, what a script can do, and a text that does."""

from typing import get_args

import pytest

from handeye.al.compiler import compile_text
from handeye.core.errors import ERRORS
from handeye.core.source import Source
from handeye.editor.checking import planning
from handeye.editor.explain import ACTIONS, REMEDIES, error_text, raised_by
from handeye.editor.samples import SAMPLE
from handeye.program.operation import Operation
from handeye.program.operations import AnyOperation
from handeye.program.program import Program

RAISING: list[type[Operation]] = [kind for kind in get_args(AnyOperation) if kind.raising]


def compiled(text: str) -> Program:
    program, _ = compile_text(Source(name="example.al", text=text), SAMPLE)
    assert program is not None
    return program


def test_every_error_number_has_a_remedy_and_something_that_raises_it() -> None:
    assert [*REMEDIES] == [*ERRORS]
    assert all(raised_by()[number] for number in ERRORS)


@pytest.mark.parametrize("number", ERRORS)
def test_the_example_of_an_error_can_raise_it_and_is_right(number: int) -> None:
    source = Source(name="example.al", text=REMEDIES[number].example)
    program, found = compile_text(source, SAMPLE)
    assert program is not None
    assert [*found, *planning(program)] == []
    assert any(number in step.operation.raises for step in program.steps)


@pytest.mark.parametrize("kind", RAISING)
def test_what_raises_an_error_is_looked_for_in_every_action(kind: type[Operation]) -> None:
    assert any(isinstance(step.operation, kind) for step in compiled(ACTIONS).steps)


def test_the_explanation_names_what_raises_an_error_and_how_to_test_it() -> None:
    first, by, *rest = error_text(23).splitlines()
    assert first == "error 23: the motion ended without meeting the force of its STOP"
    assert by == "raised by CHANGE, MOVE, PARK, PLACE, TURN"
    assert "            SKIPE   23              ;nothing was met: the pin is in" in rest
