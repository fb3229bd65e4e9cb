"""TRIG's screen shows what to type first and, on a wide terminal, the arm above its table."""

import pytest
from trig_sessions import PALLETISE, typed

from handeye.systems.trig.cli.table_view import WIDTH, table_view
from handeye.systems.trig.cli.windows import HINTS, WIDE, pictured
from handeye.systems.trig.language.command_input import Script
from handeye.systems.trig.language.command_table import COMMANDS
from handeye.systems.trig.language.no_arm import NoArm
from handeye.systems.trig.language.place import Place, Position
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.styled import ASCII, plain


def empty() -> Session:
    return Session(arm=(arm := NoArm()), table=arm, desk=Script(()))


def position(*measures: float) -> Position:
    place = Place.measured((*measures, 0.0, 0.0, 0.0))  # type: ignore[arg-type]
    return Position(relative=False, init=place, data=place)


def drawn(*measures: float, closed: bool = False, rows: int = 22, **named: Position) -> list[str]:
    here = Place.measured((*measures, 0.0, 0.0, 0.0))  # type: ignore[arg-type]
    return plain(table_view(here, named, ASCII, rows, closed=closed)).split("\n")


def test_an_empty_program_shows_commands_that_exist_and_a_program_with_steps_does_not() -> None:
    hints = plain(pictured(empty(), (80, 24)).partial)
    for typed_, told in HINTS:
        assert f"{typed_:<10}{told}" in hints
        assert typed_.split()[0] in {*COMMANDS, "HELP"}
    assert HINTS[0][1] not in plain(pictured(typed(PALLETISE), (80, 24)).partial)


@pytest.mark.parametrize("size", [(80, 24), (80, 12), (120, 24), (120, 40), (WIDE, 24)])
@pytest.mark.parametrize("make", [empty, lambda: typed(PALLETISE)])
def test_every_line_fits_its_part_of_the_terminal(size: tuple[int, int], make: object) -> None:
    picture = pictured(make(), size)  # type: ignore[operator]
    free = size[0] - 1 - (WIDTH if picture.table else 0)
    assert max(len(plain([line])) for line in picture.partial) <= free
    assert all(len(plain([line])) < WIDTH for line in picture.table)
    assert bool(picture.table) == (size[0] >= WIDE)


def test_the_hand_is_drawn_where_it_is_at_its_height_and_as_it_is_open() -> None:
    for (x, y, height), closed, mark in (((200, -200, 0), True, "@"), ((-200, 200, 300), False, "O")):
        lines = drawn(x, y, height, closed=closed)
        table = [line.split("|")[1] for line in lines if line.startswith("|")]
        row, column = (-1, -1) if x > 0 else (0, 0)
        assert table[row][column] == mark
        shown = [line for line in lines if line.startswith("|")]
        assert shown[row].endswith(f"{mark} {height}")


def test_named_positions_are_shown_and_those_beyond_the_table_are_at_its_edge() -> None:
    lines = drawn(0, 0, 300, BLOCK=position(999, 0, 6), AWAY=position(0, 200, 50))
    table = [line.split("|")[1] for line in lines if line.startswith("|")]
    assert table[0][16] == "A"
    assert table[7][-1] == "B"
    assert any("BLOCK" in line and "X 999 Y 0 Z 6" in line for line in lines)


def test_there_is_no_drawing_without_room() -> None:
    assert drawn(0, 0, 300, rows=7) == [""]
