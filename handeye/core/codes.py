"""The table of all kinds of diagnostics. The key of a kind is its code."""

from collections.abc import Mapping
from typing import Final, Literal

from msgspec import field

from handeye.core.record import Record

Severity = Literal["error", "warning"]


class Code(Record, frozen=True, kw_only=True):
    """A kind of diagnostic. It has an example text that causes the diagnostic. `required` holds the files that this
    text requires.
    """

    severity: Severity
    meaning: str
    example: str
    phase: Literal["language", "planning", "strict", "proof"] = "language"
    required: Mapping[str, str] = field(default_factory=dict)


def _error(meaning: str, example: str, required: Mapping[str, str] | None = None) -> Code:
    return Code(severity="error", meaning=meaning, example=example, required=required or {})


def _warning(meaning: str, example: str, required: Mapping[str, str] | None = None) -> Code:
    return Code(severity="warning", meaning=meaning, example=example, required=required or {})


def _proof(meaning: str, example: str) -> Code:
    return Code(severity="error", meaning=meaning, example=example, phase="proof")


def _planning(meaning: str, example: str, severity: Severity = "error") -> Code:
    return Code(severity=severity, meaning=meaning, example=example, phase="planning")


CODES: Final[dict[str, Code]] = {
    "always-undone": _warning(
        "an UNDO has no test before it, so the stage is always undone", "MOVE P\nUNDO STAGE"
    ),
    "aoj-without-search": _warning(
        "an AOJ has no SEARCH before it on any path of the program", "L: MOVE T\nAOJ L"
    ),
    "axis-count": _error(
        "a FREE or SPIN gives a number of axes, and lists more or fewer axes than this number",
        "FREE 2 X\nCHANGE X 1",
    ),
    "carries-through-fixture": _planning(
        "the part in the hand would go through a fixture",
        "TRANS OVER [32 46 3 90 90 0]\nOPEN 1\nMOVE P\nCLOSE\nMOVE OVER",
        "warning",
    ),
    "carries-through-table": _planning(
        "the part in the hand would be below the table top", "OPEN 1\nMOVE P\nCLOSE\nCHANGE [0 0 -1] 1"
    ),
    "compared-without-hold": _warning(
        "the second picture of an INSPECT or MATCH was not taken with HOLD",
        "LOOK BEFORE\nLOOK AFTER\nINSPECT BASE BEFORE AFTER",
    ),
    "count-begun-anew": _warning(
        "a loop that counts down a counter also contains an ASSIGN of this counter, so every round starts the "
        "count again",
        "L: ASSIGN N 2\nMOVE T\nSOJG N L",
    ),
    "empty-program": _error("the program has no instructions", "; nothing"),
    "endless-loop": _warning(
        "a loop that moves the arm has no exit except an error for which the program has no test",
        "L: MOVE T\nJUMP L",
    ),
    "error-never-raised": _warning(
        "a test names an error that the action before it cannot raise", "OPEN 1\nSKIPE 23\nPARK"
    ),
    "extension-used": Code(
        severity="error",
        meaning="a word or an operand is an extension by handeye, and `--strict-1973` refuses such extensions",
        example="LOAD 4",
        phase="strict",
    ),
    "finding-undecided": _proof(
        "the prover cannot decide whether every path through the program shows that a finding of the referee holds",
        "HERE A\nPARK\nMOVE A",
    ),
    "finding-unnoticed": _proof(
        "the program can end without noticing that a finding of the referee does not hold", "PARK\nMOVE T"
    ),
    "force-beyond-arm": _planning(
        "a motion asks for more force or moment than the arm can exert",
        "MOVE T\nFORCE [0 0 -900]\nCHANGE [0 0 -1] 1",
    ),
    "hand-through-fixture": _planning(
        "part of the hand would go through a fixture",
        "TRANS OVER [32 46 2 90 90 0]\nMOVE OVER\nCHANGE [0 0 -1] 1",
    ),
    "hand-through-table": _planning("part of the hand would be below the table top", "MOVE LOW"),
    "idle-loop": _warning("a loop has no exit, and no instruction in it moves the arm", "PARK\nL: JUMP L"),
    "joint-limit": _planning("a joint would move beyond its limit", "MOVE T\nTURN P 330"),
    "joint-too-fast": _planning(
        "a joint would have to move faster than it can", "PARK\nCHANGE [1 0 0] 10 70"
    ),
    "label-splits-modifier": _error(
        "a label is between a modifier and its motion, so that a jump would skip the modifier",
        "STOP 50\nL: MOVE T\nJUMP L",
    ),
    "label-twice": _error("two statements have the same label", "L: OPEN 1\nL: OPEN 2"),
    "line-too-long": _error("a line is too long", f"OPEN 1\n;{'-' * 1000}"),
    "load-beyond-arm": _planning("a load is heavier than the arm can hold", "LOAD 900\nMOVE T"),
    "macro-ends-early": _warning(
        "a macro ends with a modifier, and the motion that the modifier should change follows only after the blank "
        "line that ends the macro",
        "DEFINE DOWN\nSTOP 50\n\nCHANGE Z -1\n\nMOVE T\nDOWN\nPARK",
    ),
    "macro-name-taken": _error("a macro has the name of an instruction", "DEFINE OPEN\nPARK\n\nPARK"),
    "macro-twice": _error("two macros have the same name", "DEFINE A\nPARK\n\nDEFINE A\nPARK\n\nA"),
    "faint-force": _planning(
        "the force of a STOP is so small that the arm may mistake joint friction for this force, even in free air",
        "MOVE T\nSTOP [0 0 -5]\nCHANGE Z -1",
        "warning",
    ),
    "faint-moment": _planning(
        "the moment of a STOP is so small that the arm may mistake joint friction for this moment, even in free air",
        "MOVE T\nSTOP NIL [5 0 0]\nCHANGE Z -1",
        "warning",
    ),
    "malformed-number": _error("a number is malformed", "OPEN 1.2.3"),
    "misplaced-comma": _error("a comma is not between two operands", "CLOSE .1,"),
    "missing-operand": _error("an operand of an instruction is missing", "OPEN"),
    "modifier-misplaced": _error(
        "a modifier is before a motion that it cannot modify", "FORCE [0 0 -9]\nMOVE T"
    ),
    "modifier-twice": _error("a motion has two modifiers of the same kind", "STOP 50\nTORQUE 9\nMOVE T"),
    "modifier-without-motion": _error("a modifier is not followed by a motion", "STOP [0 0 -50]\nOPEN 1"),
    "never-saved": _warning(
        "a RESTORE or HEIGHT has no SAVE of the same name before it on any path of the program",
        "MOVE T\nRESTORE H",
    ),
    "number-out-of-range": _error("a number is too small or too large for its operand", "OPEN 5"),
    "opened-too-little": _warning(
        "the minimum gap of a grasp is wider than the gap of the open fingers", "OPEN .2\nCLOSE .25"
    ),
    "parameter-name-taken": _error(
        "a parameter has the name of an instruction, of another word of the language, of an axis or of a label",
        "DEFINE PRESS X\nCHANGE X 1\n\nPARK\nPRESS Z",
    ),
    "parameter-twice": _error(
        "a macro has two parameters with the same name", "DEFINE A S S\nMOVE S\n\nA T T"
    ),
    "part-not-described": _error(
        "the taught file lacks data that vision needs to find a part",
        "LOOK V\nGENERAL GASKET V",
    ),
    "path-leaves-reach": _planning(
        "the path of a motion leaves the arm's reach", "MOVE T\nCHANGE [0 1 0] 30"
    ),
    "position-before-here": _error("a position is used before the HERE that defines it", "MOVE A\nHERE A"),
    "position-twice": _error(
        "two positions have the same name", "TRANS A [1 2 3 0 0 0]\nTRANS A [1 2 3 0 0 0]\nPARK"
    ),
    "program-too-long": _error(
        "macros expand to too many statements, or are nested too deeply",
        "\n".join(f"DEFINE M{i}\nM{i + 1}\n" for i in range(25)) + "\nDEFINE M25\nPARK\n\nM0",
    ),
    "recursive-macro": _error("a macro uses itself", "DEFINE A\nOPEN 1\nA\n\nA"),
    "require-circle": _error(
        "a file requires itself, directly or through another file",
        "REQUIRE pins.al\nPARK",
        {"pins.al": "REQUIRE gasket.al", "gasket.al": "REQUIRE pins.al"},
    ),
    "require-in-macro": _error("a macro requires a file", "DEFINE PINS\nREQUIRE pins.al\n\nPARK\nPINS"),
    "required-twice": _warning(
        "a file is required twice",
        "REQUIRE pins.al\nREQUIRE pins.al",
        {"pins.al": "PARK"},
    ),
    "restore-without-move": _error(
        ("a RESTORE has no goal to shift, because no MOVE is directly before it"), "SAVE H\nOPEN 1\nRESTORE H"
    ),
    "save-without-move": _warning("a SAVE has no MOVE before it on any path of the program", "CLOSE\nSAVE H"),
    "search-begun-anew": _warning(
        "a SEARCH is inside its own loop, so every round of the loop restarts the search",
        "L: SEARCH .07\nMOVE T\nSTOP 50\nCHANGE Z -1\nSKIPE 23\nAOJ L",
    ),
    "search-stands-still": _warning(
        "a search has no MOVE between its label and its AOJ",
        "MOVE T\nSEARCH .07\nL: STOP 50\nCHANGE Z -1\nSKIPE 23\nAOJ L",
    ),
    "search-without-aoj": _warning(
        "a SEARCH has no AOJ after it on any path of the program", "SEARCH .07\nMOVE T"
    ),
    "skip-at-end": _error("a SKIPE or SKIPN has no instruction after it", "PARK\nSKIPE 23"),
    "skip-over-modifier": _error(
        "a SKIPE or SKIPN would skip a modifier but not its motion", "SKIPE 23\nSTOP [0 0 -50]\nMOVE T"
    ),
    "skips-one-only": _warning(
        "several indented lines follow a SKIPE or SKIPN, which skips only the first of them",
        "        CLOSE   .1\n        SKIPN   2\n            OPEN    1\n            PARK\n        WHERE",
    ),
    "specific-without-general": _warning(
        "a SPECIFIC has no GENERAL before it on any path of the program", "LOOK V\nSPECIFIC BASE V"
    ),
    "stage-twice": _error("two stages have the same name", 'STAGE "A"\nPARK\nSTAGE "A"\nPARK'),
    "stop-away-from-motion": _warning(
        "a motion moves away from the surface that should trip its STOP", "STOP [0 0 -50]\nCHANGE Z 1"
    ),
    "stop-beyond-arm": _planning(
        "the force or moment of a STOP is greater than the arm can exert",
        "MOVE T\nSTOP [0 0 -600]\nCHANGE [0 0 -1] 1",
        "warning",
    ),
    "test-of-no-effect": _warning(
        "a test has no effect because the next instruction is another test: the program continues in the same way "
        "whether or not the error of the first test was raised",
        "L: CLOSE .1 .2\nSKIPE 2\nSKIPE 7\nJUMP L\nPARK",
    ),
    "test-without-action": _warning("a test has no action directly before it", "SKIPE 23\nPARK"),
    "too-many-operands": _error("an instruction has more operands than it takes", "OPEN 1 2"),
    "too-much-required": _error(
        "too many files are required, or the files are too large",
        "REQUIRE 1.al\nPARK",
        {f"{n}.al": f"REQUIRE {n + 1}.al" for n in range(1, 102)},
    ),
    "torque-without-tool": _warning(
        "a motion waits for a torque, but no TOOL runs the screwdriver", "TORQUE 42\nCHANGE Z -.5"
    ),
    "touch-while-closed": _warning(
        "a motion waits for a touch, but the fingers are already closed",
        "CLOSE .1\nTOUCH 3\nCHANGE Z -1",
    ),
    "travel-too-long": _warning(
        "the minimum of a TRAVEL is greater than the length of the motion before it",
        "CHANGE Z .6\nTRAVEL .7 .9",
    ),
    "travel-without-change": _warning(
        "a TRAVEL has no CHANGE before it on any path of the program", "PARK\nTRAVEL .1 .2"
    ),
    "typed-word": _error("a console command is written in a script", "OPEN 3\nDO PARK"),
    "unexpected-character": _error("a character is not part of the language", "OPEN = 1"),
    "unit-written": _error("a number has a unit, but numbers are written without units", "OPEN 1.5 in"),
    "unknown-axis": _error("an axis is not X, Y or Z", "FREE 1 W\nCHANGE X 1"),
    "unknown-counter": _error(
        "an instruction uses a counter, but no ASSIGN sets this counter", "L: PARK\nSOJG N L"
    ),
    "unknown-error-number": _warning(
        "a test names an error that no instruction raises", "PARK\nSKIPE 42\nPARK\nPARK"
    ),
    "unknown-instruction": _error("a word is neither an instruction nor a macro", "GRAB 1"),
    "unknown-label": _error("a jump goes to a label that no statement has", "JUMP NOWHERE"),
    "unknown-lens": _error("the lens turret has no lens with this focal length", "LENS 35"),
    "unknown-parameter": _warning(
        "a text in a macro contains a name in braces that is not a parameter of the macro",
        'DEFINE A S\nMOVE S\nWAIT "NOT AT {P}"\n\nA T',
    ),
    "unknown-part": _error("a part is unknown", "TRANS A [0 0 0 0 0 0] OF LID\nPARK"),
    "unknown-picture": _error(
        "an instruction uses a picture, but no LOOK takes this picture", "GENERAL BASE VIEW"
    ),
    "unknown-position": _error("a position is not in the taught file, and no TRANS defines it", "MOVE X9"),
    "unknown-target": _error("the target of the camera is neither a position nor a part", "AIM X9"),
    "unknown-vector": _error("a vector is neither an axis nor defined by VECT", "CHANGE DOWN 1"),
    "unopened-vector": _error("a vector has no opening bracket", "CHANGE 0 0 -1] 0.6"),
    "unreachable-code": _warning("a statement is never executed", "JUMP L\nOPEN 1\nL: PARK"),
    "unreachable-position": _planning("a position is out of the arm's reach", "MOVE FAR"),
    "unreadable-file": _error("a required file cannot be read", "REQUIRE pins.al\nPARK"),
    "unterminated-macro": _error("the blank line that ends a macro is missing", "PARK\nDEFINE A\nOPEN 1"),
    "unterminated-string": _error("a string has no closing quote", 'STAGE "one'),
    "unterminated-vector": _error("a vector has no closing bracket", "CHANGE [0 0 -1 0.6"),
    "unused-label": _warning("a label is never used: no instruction jumps to it", "L: PARK"),
    "unused-macro": _warning("a macro is never used", "PARK\nDEFINE A\nOPEN 1\n\n"),
    "unused-parameter": _warning("a parameter of a macro is never used", "DEFINE A S\nPARK\n\nA T"),
    "unused-position": _warning("a position is defined but never used", "TRANS A [1 2 3 0 0 0]\nPARK"),
    "unused-vector": _warning("a vector is defined but never used", "VECT D [0 0 1]\nPARK"),
    "vector-size": _error("a vector has too few or too many numbers", "CHANGE [0 0] 1"),
    "vector-twice": _error(
        "two vectors have the same name, or a vector has the name of an axis", "VECT Z [0 0 1]\nCHANGE Z 1"
    ),
    "wait-for-time": _warning(
        "a WAIT seems to be intended as a delay, but WAIT calls the operator", "PARK\nWAIT 2"
    ),
    "wrist-in-line": _planning(
        "a straight motion passes a point at which the axes of two joints line up, and there the hand cannot keep "
        "its angles",
        "TRANS AHEAD [14 40 24 180 0 0]\nMOVE AHEAD\nCHANGE [0 0 -1] 4",
    ),
    "wrong-operand": _error("an operand is of the wrong kind", "OPEN T"),
    "zero-vector": _error("a direction vector has length 0", "CHANGE [0 0 0] 1"),
}
