"""Scripts with one mistake each, written without looking at the checker: each is told, and nothing else.

Of the first twenty (`a`) sixteen were told as wished for at once, of the second (`b`) seventeen. Of a third set 41 of
59 were; most of the others are here (`c`). A fourth set kept to mistakes of meaning, with every line right by itself:
twelve of 24 were told at once, and 22 are here (`d`). They have led to new diagnostics and better words. Of a fifth
set, of what a class may write in its first week (`e`), all twenty got one message, about their mistake; the help of one
of them was none.
"""

from pathlib import Path

import pytest

from handeye.al import AL, compile_text
from handeye.arm.robots.stanford import STANFORD
from handeye.core.resources import plans
from handeye.core.source import read_source
from handeye.planning.planner import plan_program
from handeye.program.taught import Taught, load_taught

HERE = Path(__file__).parent / "broken"
PUMP = load_taught(plans() / "water_pump.toml")
MISTAKES = {
    "a01": ("unknown-instruction", 6, "there is no instruction `CLOES`"),
    "a02": ("unknown-position", 9, "position `p` is not in the taught file"),
    "a03": ("missing-operand", 7, "the distance of `CHANGE` is missing"),
    "a04": ("unopened-vector", 3, "the vector has no opening bracket"),
    "a05": ("unterminated-macro", 4, "macro `GRAB` has no end"),
    "a06": ("unknown-label", 12, "there is no label `AGAIN`"),
    "a07": ("malformed-number", 6, "a comma separates two operands"),
    "a08": ("modifier-misplaced", 7, "`FORCE` cannot modify `MOVE`"),
    "a09": ("error-never-raised", 12, "`OPEN` does not raise error 23 here"),
    "a10": ("error-never-raised", 8, "`CLOSE` does not raise error 7 here"),
    "a11": ("search-begun-anew", 12, "`AOJ` jumps back to a label before the `SEARCH`"),
    "a12": ("search-stands-still", 12, "there is no `MOVE` between the label and this `AOJ`"),
    "a13": ("unterminated-string", 4, "the string has no closing quote"),
    "a14": ("restore-without-move", 10, "there is no `MOVE` to shift"),
    "a15": ("label-twice", 17, "label `GOT` is defined twice"),
    "a16": ("number-out-of-range", 5, "`4.5` is too large for the gap of `OPEN`"),
    "a17": ("unreachable-position", 8, "BOX is 21.87 in beyond the reach"),
    "a18": ("stop-beyond-arm", 8, "the arm cannot press with 6000 oz here"),
    "a19": ("count-begun-anew", 12, "`SOJG` jumps back to a label before the `ASSIGN`"),
    "a20": ("unknown-position", 9, "`DOWN` is a vector, not a position"),
    "b01": ("unterminated-macro", 6, "macro `GRASP` has no end"),
    "b02": ("search-begun-anew", 13, "`AOJ` jumps back to a label before the `SEARCH`"),
    "b03": ("unreachable-code", 12, "this line is never executed"),
    "b04": ("test-without-action", 11, "`SKIPN` follows no action"),
    "b05": ("stop-away-from-motion", 9, "the hand moves away from the surface on which the `STOP`"),
    "b06": ("too-many-operands", 8, "`STOP` takes no more operands"),
    "b07": ("count-begun-anew", 12, "`SOJG` jumps back to a label before the `ASSIGN`"),
    "b08": ("modifier-misplaced", 10, "`SPIN` cannot modify `MOVE`"),
    "b09": ("restore-without-move", 12, "there is no `MOVE` to shift"),
    "b10": ("position-before-here", 11, "position `TOP` is used before `HERE` defines it"),
    "b11": (
        "faint-moment",
        9,
        "the arm can hardly distinguish a moment of 0.2 oz-in from joint friction here",
    ),
    "b12": ("load-beyond-arm", 9, "the arm cannot carry 900 oz"),
    "b13": ("joint-limit", 10, "`MOVE STUD` would take joint 5 (wrist bend) 25.4 degrees beyond"),
    "b14": ("joint-limit", 8, "`TURN` would take joint 6 (hand roll) 362.2 degrees beyond"),
    "b15": ("unexpected-character", 8, "`:` is not part of the language"),
    "b16": ("travel-too-long", 11, "`TRAVEL` needs at least 0.7 in, but the motion is at most 0.6 in"),
    "b17": ("error-never-raised", 8, "`CHANGE` does not raise error 23 here"),
    "b18": ("modifier-without-motion", 12, "no motion follows `VIA`"),
    "b19": ("opened-too-little", 6, "the grasp needs at least 0.25 in, but the hand is open only 0.2 in"),
    "b20": ("hand-through-table", 10, "the hand would be 2.00 in below the table"),
    "c01": ("unknown-instruction", 8, "there is no instruction `L1`"),
    "c02": ("wrong-operand", 7, "a vector must contain only numbers, not `O`"),
    "c03": ("unknown-instruction", 7, "there is no instruction `hole`"),
    "c04": ("unknown-label", 8, "label `AGAIN` belongs to a macro"),
    "c05": ("unexpected-character", 7, "`(0` is not part of the language"),
    "c06": ("unexpected-character", 9, "`-Z` is not part of the language"),
    "c07": ("wrong-operand", 8, "`FREE` takes a vector [x y z], not a name"),
    "c08": ("missing-operand", 9, "the force of `STOP` is missing"),
    "c09": ("unexpected-character", 12, "`−60` is not part of the language"),
    "c10": (
        "torque-without-tool",
        11,
        "this motion waits for a torque, but the screwdriver does not turn",
    ),
    "c11": (
        "wrong-operand",
        10,
        "`AGAIN` is a label and `TRIES` a counter, but `SOJG` takes them in the other order",
    ),
    "c12": ("unknown-instruction", 11, "there is no instruction `CALL`"),
    "c13": ("skip-at-end", 12, "there is no instruction for `SKIPN` to skip"),
    "c14": (
        "wait-for-time",
        5,
        "`WAIT` stops the run and calls the operator; it is not a delay",
    ),
    "c15": ("wrong-operand", 6, "another operand must come before `DIRECT`"),
    "c16": ("wrong-operand", 4, "the maximum of `CLOSE` must be a number, not a name"),
    "c17": ("never-saved", 9, "no `SAVE` saves a difference `El`"),
    "c18": ("unknown-label", 15, "label `TRY` belongs to a macro"),
    "c19": ("number-out-of-range", 6, "`7` is too large for the step of `SEARCH`"),
    "c20": ("faint-force", 4, "the arm can hardly distinguish a force of 0.2 oz from joint friction here"),
    "d02": ("label-splits-modifier", 6, "label `DOWN` is between `STOP` and its motion"),
    "d03": ("search-stands-still", 12, "there is no `MOVE` between the label and this `AOJ`"),
    "d04": ("search-begun-anew", 25, "`AOJ` jumps back to a label before the `SEARCH`"),
    "d05": (
        "test-of-no-effect",
        6,
        "the program continues in the same way whether or not error 2 was raised",
    ),
    "d06": ("skips-one-only", 6, "`SKIPN` skips one instruction, not the indented block"),
    "d07": (
        "wait-for-time",
        6,
        "`WAIT` stops the run and calls the operator; it is not a delay",
    ),
    "d08": ("missing-operand", 14, "the force of `STOP` is missing"),
    "d09": ("joint-limit", 6, "`MOVE SHELF` would take joint 5 (wrist bend) 36.8 degrees beyond its limit"),
    "d10": ("malformed-number", 6, "a comma separates two operands"),
    "d11": ("wrong-operand", 6, "the position of `VIA` must be a name, not a vector"),
    "d12": (
        "carries-through-fixture",
        7,
        "0.6 in along this `CHANGE`, `SCREWDRIVER` in the hand would go 0.36 in",
    ),
    "d13": ("faint-force", 9, "the arm can hardly distinguish a force of 1 oz from joint friction here"),
    "d15": (
        "torque-without-tool",
        20,
        "this motion waits for a torque, but the screwdriver does not turn",
    ),
    "d16": ("opened-too-little", 4, "the grasp needs at least 0.9 in, but the hand is open only 0.6 in"),
    "d17": ("travel-too-long", 10, "`TRAVEL` needs at least 1.6 in, but the motion is at most 1.3 in"),
    "d18": ("touch-while-closed", 9, "this motion waits for a touch, but the fingers are closed"),
    "d19": ("unknown-position", 10, "`FOUND` is a saved difference, not a position"),
    "d20": (
        "compared-without-hold",
        15,
        "picture `AFTER` is not taken at the target voltage of picture `BEFORE`",
    ),
    "d21": ("part-not-described", 5, "`GENERAL` cannot find `PUMP` without its `region`"),
    "d22": (
        "macro-ends-early",
        2,
        "macro `SETDOWN` ends with `STOP`, but the motion that it modifies is outside the macro",
    ),
    "d23": ("unreadable-file", 1, "`water_pump.toml` is a taught file"),
    "d24": ("unreachable-position", 3, "RIM is 11.23 in beyond the reach of the Stanford arm"),
    "e01": ("unknown-instruction", 6, "there is no instruction `L1`"),
    "e02": ("unterminated-vector", 8, "the vector has no `]`"),
    "e03": ("malformed-number", 5, "a comma separates two operands"),
    "e04": (
        "count-begun-anew",
        11,
        "`SOJG` jumps back to a label before the `ASSIGN`, so every round executes the `ASSIGN` again",
    ),
    "e05": ("wrong-operand", 4, "`CHANGE` takes a vector [x y z] or its name, not a number"),
    "e06": ("unexpected-character", 5, "`−30` is not part of the language"),
    "e07": ("unknown-instruction", 8, "there is no instruction `SKIP`"),
    "e08": ("unused-position", 2, "position `ROD` is defined but never used"),
    "e09": ("unterminated-macro", 3, "macro `TAP` has no end"),
    "e10": ("unexpected-character", 5, "`:` is not part of the language"),
    "e11": ("unknown-position", 6, "position `P1_UP` is not in the taught file, and no `TRANS` defines it"),
    "e12": (
        "stop-away-from-motion",
        11,
        "the hand moves away from the surface on which the `STOP` should end the motion",
    ),
    "e13": (
        "search-begun-anew",
        20,
        "`AOJ` jumps back to a label before the `SEARCH`, so every round executes the `SEARCH` again",
    ),
    "e14": (
        "search-begun-anew",
        9,
        "`AOJ` jumps back to a label before the `SEARCH`, so every round executes the `SEARCH` again",
    ),
    "e15": ("test-without-action", 9, "`SKIPE` follows no action: there is no error to test"),
    "e16": ("unreachable-code", 6, "this line is never executed"),
    "e17": ("opened-too-little", 4, "the grasp needs at least 0.9 in, but the hand is open only 0.6 in"),
    "e18": ("unreachable-position", 10, "SHELF is 39.24 in beyond the reach of the Stanford arm"),
    "e19": ("load-beyond-arm", 7, "the arm cannot carry 1020 oz on this motion"),
    "e20": ("modifier-without-motion", 6, "no motion follows `STOP`"),
}


@pytest.mark.parametrize("name", MISTAKES)
def test_the_mistake_is_told_at_its_line_and_nothing_else_is(name: str) -> None:
    source = read_source(HERE / f"{name}.al")
    program, found = compile_text(source, PUMP if name[0] in "cde" else Taught())
    if program is not None:
        found += plan_program(program, STANFORD, AL)[1]
    (told,) = found
    code, line, message = MISTAKES[name]
    assert (told.code, source.position(told.primary.span.start)[0]) == (code, line)
    assert told.message.startswith(message)


def test_every_script_is_in_the_table() -> None:
    assert {file.stem for file in HERE.iterdir()} == set(MISTAKES)
