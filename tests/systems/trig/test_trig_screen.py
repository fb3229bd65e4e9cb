"""TRIG's editor at a terminal: what is typed, driven and struck, and what is to be seen."""

from collections import deque
from collections.abc import Callable

import pytest
from prompt_toolkit.data_structures import Size
from prompt_toolkit.input import create_pipe_input
from prompt_toolkit.output import DummyOutput
from trig_sessions import PALLETISE, typed

from handeye.systems.trig.cli.screen import Screen
from handeye.systems.trig.cli.windows import _drawn
from handeye.systems.trig.language.command_input import Script, hear
from handeye.systems.trig.language.no_arm import NoArm
from handeye.systems.trig.language.session import Session

pytestmark = pytest.mark.slow

STRIKE = "strike"
"""In the place of what is typed: a key, while the arm moves."""


class Terminal(DummyOutput):
    """A terminal of a size."""

    def get_size(self) -> Size:
        return Size(rows=24, columns=80)


def shown(session: Session, keys: list[str], look: Callable[[Screen], None] = lambda _: None) -> Screen:
    """The screen after keys were struck, each text when something was waited for; then somebody leaves."""
    waiting = deque([*keys, "Q\r"])
    with create_pipe_input() as pipe:

        def type_on(_: object) -> None:
            look(screen)
            pipe.send_text(waiting.popleft())

        screen = Screen(session, pace=0.0, waits=type_on, input=pipe, output=Terminal())
        screen.run()
    assert not waiting
    return screen


def empty() -> Session:
    """A session that begins."""
    return Session(arm=(arm := NoArm()), table=arm, desk=Script(()))


def told(screen: Screen) -> list[str]:
    """What stands in the program editor."""
    return [text for _, text in screen.told]


def test_a_move_is_taught_by_the_keys_of_the_box_and_gone_to_again() -> None:
    session = empty()
    screen = shown(session, ["M CENTER\r", "X", "X", "+\x1b[A", "-z", "\r", "GRASP\r", "M CENTER\r", "y\r"])
    assert session.program.positions["CENTER"].data.measures() == (20, 50, 290, 0, 0, 0)
    assert [step.type for step in session.program.graph.steps()] == ["normal", "grasp", "normal"]
    assert told(screen) == [
        ">M CENTER", ">GRASP", ">M CENTER", "Move to the predefined location? y", ">Q"
    ]  # fmt: skip


def test_the_kill_switch_and_control_c_leave_no_step() -> None:
    session = empty()
    screen = shown(session, ["M A\r", "k", "M A\r", "\x03", "FREE\r", "\r", "HERE A\r", "M A\r", "\x03"])
    assert list(session.program.graph.steps()) == []
    assert "the kill switch has stopped the arm; nothing was recorded" in told(screen)
    assert told(screen).count("cancelled") == 2


def test_any_key_stops_a_run_which_can_be_taken_back() -> None:
    session = typed(PALLETISE)
    arm = session.arm
    assert isinstance(arm, NoArm)
    hear(session, "GOPOS CENTER")
    before = list(arm.blocks)
    screen = Screen(session, output=Terminal())
    count = 0

    def halted() -> bool:
        nonlocal count
        count += 1
        if count == 40:
            screen.strike()
        return Screen.halted(screen)

    screen._pace = 0.0
    screen.mode = "busy"
    runner = session.runner
    runner.halted = halted
    assert runner.run().end == "halted"
    assert arm.blocks != before
    runner.back(1000)
    assert [block.name for block in arm.blocks] == [block.name for block in before]


def test_both_displays_and_the_arm_are_on_the_screen() -> None:
    pictures: list[str] = []

    def look(screen: Screen) -> None:
        picture = screen.picture()
        pictures.append(
            "".join(piece[1] for piece in [*_drawn(picture.full), *_drawn(picture.partial)]) + picture.arm
        )

    session = empty()
    shown(session, ["M CENTER\r", "X", "\r", "GRASP\r"], look)
    assert pictures[0].startswith(" [ ]\n ▶\n \n The program is empty.")
    assert pictures[0].endswith("\narm X 0 Y 0 Z 300   hand open")
    assert pictures[-1] == "  o[c]\n    ***  CENTER\n ▶  ***  (grasp)\narm X 10 Y 0 Z 300   hand closed"


def test_long_answers_have_a_page_that_the_next_line_closes() -> None:
    pages: list[int] = []
    screen = shown(empty(), ["HELP\r", "CALPOS\r"], lambda screen: pages.append(len(screen.page)))
    assert (pages[0], pages[1] > 37, pages[2]) == (0, True, 0)
    assert all(len(line) < 80 for line in screen.page)


def test_a_mistake_is_told_and_the_next_line_is_heard() -> None:
    screen = shown(empty(), ["GRAPS\r", "GRASP\r"])
    assert told(screen)[:2] == [">GRAPS", "there is no command `GRAPS`; did you mean GRASP?"]


def test_control_d_leaves() -> None:
    with create_pipe_input() as pipe:
        screen = Screen(empty(), waits=lambda _: pipe.send_text("\x04"), input=pipe, output=Terminal())
        screen.run()
    assert told(screen) == []


def test_what_fails_within_comes_out_when_the_terminal_is_as_it_was(monkeypatch: pytest.MonkeyPatch) -> None:
    def broken(*_: object) -> None:
        raise RuntimeError("a bug")

    monkeypatch.setattr("handeye.systems.trig.cli.screen.hear", broken)
    with pytest.raises(RuntimeError, match=r"^a bug$"):
        shown(empty(), ["GRASP\r"])
