"""Both displays of TRIG as text."""

from itertools import pairwise

import pytest
from trig_sessions import BUCKET, PALLETISE, Typist, straight

from handeye.systems.trig.language.display import full_display, layout, partial_display
from handeye.systems.trig.language.graph import NORMAL
from handeye.systems.trig.language.styled import ASCII, UNICODE, plain, symbols_for

FIGURE_10 = """\
   ***  CENTER
   ***  BLOCK
   ***  (grasp)
   ***  OVER-BUCKET
▶  ***  (ungrasp)"""
FIGURE_11 = """\
   ***  CENTER
   ***  BLOCK
   ***  (grasp)
   ***  OVER-BUCKET
   ***  (ungrasp)
   ***  OTHER-BLOCK
   ***  (grasp)
   ***  BLOCK
   ***  (ungrasp)
▶  ***  CENTER"""
FIGURE_16 = """\
                            ***        (grasp)
                            ***        PALLET
                            ***        #PLACE
                            ***        (ungrasp)
                            ***        -#PLACE
                            ***        #NEXT-ROW
                            RECALC1    =PALLET
                            LOOP GET-BLOCK 2 (0)
                            ***        #NEWROW
                            RECALC2    =PALLET
                         ▶  LOOP GET-BLOCK 4 (0)
                            [FINISH]"""
FIGURE_17 = """\
   ***        CENTER
▶  GET-BLOCK  STACK
   ***        (grasp)
   ***        BOTTOM G ─────┐
 n FINISH     DONE        g ***        #RAISE
                            ***        (ungrasp)
                            ***        #LOWER
                            ***        (grasp)
                            ***        PALLET
                            ***        #PLACE
                            ***        (ungrasp)
                            ***        -#PLACE"""
MINIATURE = """\
 o[o]c─<┬o
        └o─u─o─c─o─o─u─o─o─=─@─o─=─@─^"""


def partial(typist: Typist, width: int = 78, height: int = 12) -> str:
    """The partial display."""
    return plain(partial_display(typist.session.program, width, height))


def full(typist: Typist, width: int = 78, height: int = 8) -> str:
    """The full display."""
    return plain(full_display(typist.session.program, width, height))


@pytest.mark.trig_row(1)
def test_both_displays_begin_with_nothing_but_a_cursor() -> None:
    assert (partial(Typist()), full(Typist())) == ("▶", "[ ]")


@pytest.mark.trig_row(2)
def test_a_first_step_is_shown_with_the_cursor_on_it() -> None:
    assert partial(Typist("M CENTER\nX 10 RECORD")) == "▶  ***  CENTER"


def test_the_pictures_of_the_first_example() -> None:
    typist = Typist(BUCKET[: BUCKET.index(">M OTHER-BLOCK")])
    assert partial(typist) == FIGURE_10
    assert partial(Typist(BUCKET)) == FIGURE_11


@pytest.mark.trig_row(40)
def test_the_partial_display_shows_the_part_where_the_cursor_is() -> None:
    typist = Typist(PALLETISE)
    assert partial(typist) == FIGURE_16
    assert full(typist).endswith("─=[@]^")
    typist.type("GOTO GET-BLOCK")
    assert partial(typist) == FIGURE_17
    assert full(typist) == MINIATURE


@pytest.mark.slow
@pytest.mark.trig_row(40)
def test_both_displays_show_the_same_step_at_every_moment_of_a_run() -> None:
    typist = Typist(PALLETISE)
    seen: list[tuple[str, str]] = []

    def look() -> bool:
        program = typist.session.program
        marks = [
            text for line in partial_display(program, 78, 12) for style, text in line if style == "active"
        ]
        brackets = [
            text for line in full_display(program, 78, 8) for style, text in line if style == "active"
        ]
        assert (len(marks), len(brackets)) == (1, 3)
        seen.append((marks[0].split()[-1], brackets[1]))
        return False

    typist.halted = look
    typist.type("RUN")
    assert {sign for _, sign in seen} == {*"ocu=@<"}
    assert {("GET-BLOCK", "o"), ("(grasp)", "c"), ("=PALLET", "="), ("(4)", "@")} - {*seen} == {
        ("GET-BLOCK", "o")
    }


@pytest.mark.slow
@pytest.mark.trig_row(22)
def test_bloops_are_never_shown_and_counts_are_live() -> None:
    typist = Typist(PALLETISE)
    pictures: list[str] = []
    typist.halted = lambda: bool(pictures.append(partial(typist, height=40) + full(typist)))
    typist.type("RUN")
    for picture in (partial(typist, height=40), *pictures):
        assert "bloop" not in picture.lower()
        assert len(picture.split("***")) == 14
    counts = [picture.split("LOOP GET-BLOCK 2 (")[1][0] for picture in pictures]
    assert "".join(dict.fromkeys(counts)) == "012"
    assert sum(a == "2" and b == "0" for a, b in pairwise(counts)) == 4


def test_kinds_of_steps_look_different() -> None:
    typist = Typist(
        "M\nX 1 RECORD\nMR A\nX BY 1 RECORD\nM -A\nYes\nSAVPOS B\nMAG C\nZ 9 RECORD\n1\n(0 0 1)\n"
    )
    assert partial(typist).splitlines() == [
        "   ***  - -", "   ***  #A", "   ***  -#A", "   ***  =B", "▶  ***  C G"
    ]  # fmt: skip


def test_long_names_are_cut_and_no_line_is_wider_than_the_screen() -> None:
    name = "LONG-" * 8
    typist = Typist(
        f"M {name}\nX 1 RECORD\nCN {name}\nLOOP {name} 999999999\nMG X\nZ 9 RECORD\n1\n(0 0 1)\nGRASP\ng"
    )
    for width in (20, 40, 80, 120):
        assert all(
            len(line) <= width
            for line in partial(typist, width).splitlines() + full(typist, width).splitlines()
        )
    assert "LONG-LONG-LONG-…" in partial(typist)


def test_a_program_that_is_too_large_is_shown_around_the_cursor() -> None:
    typist = Typist(straight(60) + "\nGOTO S30")
    lines = partial(typist).splitlines()
    assert (len(lines), [line[:6] for line in lines if "▶" in line]) == (12, ["▶  S30"])
    assert "S29" in lines[lines.index(next(line for line in lines if "▶" in line)) - 1]
    assert (full(typist)[0], full(typist)[-1], len(full(typist))) == ("…", "…", 78)


def test_branches_of_branches_never_cross() -> None:
    fork = "MG DOWN {}\nYes\n1\n(0 0 1)\nCN F{}\n"
    text = "M UP\nZ 100 RECORD\nM DOWN\nZ 5 RECORD\n" + "MG DOWN\nYes\n1\n(0 0 1)\nCN F0\n"
    for number in range(1, 25):
        text += f"GOTO F{(number - 1) // 2}\n" + fork.format("ng"[number % 2], number)
    drawn = layout(Typist(text).session.program.graph)
    taken = {(cell.row, cell.column) for cell in drawn.cells}
    assert len(taken) == len(drawn.cells) == 27
    for elbow in drawn.elbows:
        assert (elbow.row + 1, elbow.end) in taken
        assert not any((elbow.row, column) in taken for column in range(elbow.start + 1, elbow.end + 1))


def test_a_deep_program_is_drawn() -> None:
    typist = Typist("M DOWN\nZ 5 RECORD\n")
    graph = typist.session.program.graph
    for number in range(1500):
        node = graph.new("guarded")
        node.position, node.threshold, node.vector = "DOWN", 1.0, (0.0, 0.0, 1.0)
        graph.insert(typist.session.program.cursor, NORMAL if number == 0 else 1, node)
        typist.session.program.put_cursor(node.id)
    assert partial(typist).count("DOWN G") > 0
    assert full(typist, 40, 5).count("\n") == 4


def test_a_terminal_without_the_signs_gets_others() -> None:
    assert (symbols_for("utf-8"), symbols_for("latin-1"), symbols_for(None)) == (UNICODE, ASCII, ASCII)
    picture = plain(partial_display(Typist(PALLETISE).session.program, 78, 40, ASCII))
    assert picture.isascii()
