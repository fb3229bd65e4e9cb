"""TRIG's editor at a terminal that only takes lines."""

import sys
from collections.abc import Iterator

import pytest
from conftest import Command

from handeye.cli.panic_button import PanicButton
from handeye.systems.trig.cli import lines as trig_lines
from handeye.systems.trig.language.command_input import Script
from handeye.systems.trig.language.no_arm import NoArm
from handeye.systems.trig.language.session import Session


def typed(monkeypatch: pytest.MonkeyPatch, *lines: str) -> Session:
    """The session after somebody has typed lines, and Ctrl-D."""
    waiting = iter(lines)

    def typed_lines(prompt: str, *_: object, **__: object) -> Iterator[str]:
        yield from (line for line in [next(waiting, None)] if line is not None)

    monkeypatch.setattr(trig_lines, "typed_lines", typed_lines)
    session = Session(arm=(arm := NoArm()), table=arm, desk=Script(()))
    trig_lines.converse(session, PanicButton())
    return session


def test_a_program_is_taught_line_by_line(
    monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]
) -> None:
    session = typed(
        monkeypatch, "M CENTER", "X 10 UP", "X 10", "RECORD", "GRAPS", "M CENTER", "perhaps", "yes"
    )
    assert [step.position for step in session.program.graph.steps()] == ["CENTER", "CENTER"]
    out = capsys.readouterr().out
    assert "`UP` is not a control of the teach box" in out
    assert "did you mean GRASP?" in out
    assert "`perhaps` is not an answer; type Yes or No" in out
    assert out.endswith(" o[o]\n\n   ***  CENTER\n▶  ***  CENTER\n\nX 10 Y 0 Z 300, hand open\n")


def test_an_empty_answer_cancels(monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str]) -> None:
    session = typed(monkeypatch, "M CENTER", "", "GRASP")
    assert [step.type for step in session.program.graph.steps()] == ["grasp"]
    assert "cancelled" in capsys.readouterr().out


def test_without_the_library_of_the_screen_lines_are_enough(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "handeye.systems.trig.cli.screen", None)
    monkeypatch.setattr("handeye.systems.trig.cli.commands.at_terminal", lambda: True)
    monkeypatch.setattr(trig_lines, "typed_lines", lambda *_, **__: iter(["Q"]))
    code, out, err = command("trig")
    assert (code, out) == (0, "\n[ ]\n\n▶\n\nX 0 Y 0 Z 300, hand open\n")
    assert err.startswith("`trig` needs prompt_toolkit, which is not installed")
    assert err.endswith("without this package you can type lines, but there is no screen\n")
