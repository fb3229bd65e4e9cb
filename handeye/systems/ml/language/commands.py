"""The table of the 106 command words of ML: 76 words name commands, and 30 words name tables. The parser, the checks,
the completion, `explain` and the page of commands are derived from this table.
"""

import re
from functools import cache
from typing import Final, Literal

from handeye.core.record import Record
from handeye.systems.ml.tables.layout import SHAPES
from handeye.systems.ml.tables.store import word_of

Category = Literal["control", "flow", "motion", "sense", "data", "arithmetic", "edit", "test", "host"]
Kind = Literal["value", "variable", "statement", "motor", "sensor", "table", "line", "word", "text"]
MOST_PARAMETERS: Final = 15
_KINDS: Final[dict[str, Kind]] = {
    "v": "variable", "w": "variable", "n": "statement", "m": "motor", "s": "sensor", "t": "table", "f": "text",
    "line": "line", "word": "word",
}  # fmt: skip


class Command(Record, frozen=True, kw_only=True):
    """A command. `usage` lists the parameters of the command. Parameters in `[ ]` may be left out. The parameter
    before `...` may be repeated.
    """

    code: str
    category: Category
    usage: str = ""
    help: str
    example: str

    @property
    def form(self) -> str:
        """The command with its parameters."""
        return f"{self.code} {self.usage}".rstrip()

    @property
    def counts(self) -> frozenset[int]:
        """The allowed numbers of parameters of the command."""
        return _counts(self.usage)

    def kind(self, number: int) -> Kind:
        """The kind of the parameter with this number, counted from 0."""
        names = _names(self.usage)
        name = names[min(number, len(names) - 1)]
        return _KINDS.get(name) or _KINDS.get(name.rstrip("0123456789"), "value")


@cache
def _counts(usage: str) -> frozenset[int]:
    counts, number = set(), 0
    for word in usage.replace("[", " [ ").replace("]", " ").split():
        if word == "...":
            counts |= set(range(number, (12 if usage.endswith("x12") else MOST_PARAMETERS) + 1))
        elif word == "[":
            counts.add(number)
        elif word != "x12" or "..." not in usage:
            number += 1
    return frozenset(counts | {number})


@cache
def _names(usage: str) -> tuple[str, ...]:
    return tuple(re.findall(r"[a-z][a-z0-9]*", usage))


_ROWS: Final[dict[Category, tuple[tuple[str, str, str, str], ...]]] = {
    "control": (
        ("ENABLE", "", "Switch the pump on. No motor moves; each motor holds its present position.", "ENABLE"),
        ("DISABLE", "", "Freeze all motors, then switch the pump off.", "DISABLE"),
        ("EXIT", "", "Switch the pump off and leave MOS.", "EXIT"),
        ("LEFT", "", "All commands that follow are for the left arm.", "LEFT"),
        ("RIGHT", "", "All commands that follow are for the right arm. At the start, commands are for the right arm.",
         "RIGHT"),
        ("PRINT", "[x ...]", "Print up to 15 values on a line.", "90 PRINT &1 &2"),
        ("RUN", "[n]", "Run the stored program from statement n; without n, from its first statement.", "RUN 100"),
        ("TRY", "[n]", "Run the stored program one statement at a time: each statement waits for a key.", "TRY"),
        ("TRACE", "[x]", (
            "Before each statement runs, print the statement with its values; `TRACE 0` ends the printing."
        ), "TRACE"),
    ),
    "flow": (
        ("BAL", "v n", "Put the number of the next statement into variable v and go to statement n; "
                       "`BRANCH &v` returns.", "100 BAL 9 400"),
        ("BRANCH", "n1 [n2 [s ...]]", (
            "Without n2, go to n1. With n2, go to n1 if at least one listed sensor fulfils its condition, and to "
            "n2 if none does. The condition of s is that its flag is on, and the condition of -s is that its flag "
            "is off. If no sensors are listed, go to n1 if any flag is on, and to n2 if none is."
        ),
         "400 BRANCH 500 410 5 14"),
        ("BRCOMP", "n1 [n2]", (
            "Go to n1 if the comparison indicator is on. If it is off, go to n2; without n2, go to the next statement."
        ),
         "40 BRCOMP 100"),
        ("BROVFL", "n1 [n2]", (
            "Go to n1 if the overflow indicator is on. If it is off, go to n2; without n2, go to the next "
            "statement. The statement does not change the indicator."
        ), "40 BROVFL 100 200"),
        ("DELAY", "x", "Wait x hundredths of a second. Guards on sensors stay active.", "50 DELAY 100"),
        ("GOSUB", "n", "Go to a subroutine. A subroutine cannot call another subroutine with GOSUB.", "60 GOSUB 900"),
        ("IF", "x n1 n2 n3", "Go to n1 if x is less than zero, to n2 if it is zero, to n3 if it is greater.",
         "70 IF &1 100 200 300"),
        ("LOOPI", "x [v]", (
            "Run the statements from here to NEXTI, x times in all. Variable v counts the rounds, from 1."
        ), "10 LOOPI 3 20"),
        ("LOOPJ", "x [v]", (
            "Run the statements from here to NEXTJ, x times in all. LOOPJ may be inside LOOPI, and LOOPI inside LOOPJ."
        ),
         "20 LOOPJ 4"),
        ("NEXTI", "", "The end of the statements that LOOPI repeats.", "80 NEXTI"),
        ("NEXTJ", "", "The end of the statements that LOOPJ repeats.", "70 NEXTJ"),
        ("RETURN", "", "Go back to the statement after the GOSUB that called the subroutine.", "950 RETURN"),
        ("STOP", "", "End the program. The arm holds its position.", "99 STOP"),
    ),
    "motion": (
        ("DEFPOINT", "n", "Store the positions of all motors in the POINT with this number.", "10 DEFPOINT 5"),
        ("DMOTOR", "m x", "Move one motor by the distance x from its present goal.", "295 DMOTOR 2 -100"),
        ("DMOVE", "x1 ... x12", "Move each motor by a distance from its present goal. Motors that are left out do not "
                                "move.",
         "4 DMOVE 0 0 &1 &2"),
        ("GOPOINT", "n [x]", "Go to the positions of a POINT. If x is 1, do not wait for the end of the motion.",
         "280 GOPOINT 5"),
        ("HAND", "x11 [x12]", "Move only the fingers: x11 is their separation, and x12 is the angle between them.",
         "30 HAND 650 900"),
        ("JOY", "n", "Guide the arm with the joystick; the record key stores the positions of the motors in a POINT.",
         "JOY 5"),
        ("MOTOR", "m x", "Move one motor to a position.", "288 MOTOR 3 4000"),
        ("MOVE", "x1 ... x12", "Move each motor to a position. Motors that are left out keep their goals.",
         "285 MOVE 0 0 2000 0 0 0 0 0 4000 -9000 650 1900"),
    ),
    "sense": (
        ("CALIB", "[s ...]", (
            "For each listed sensor, take the mean of its last eight readings as its new zero. If no sensors are "
            "listed, do so for all analog sensors."
        ), "20 CALIB 5 6 7"),
        ("SENSOR", "[s [lo hi]]", (
            "Clear the flag of a sensor, and guard the sensor: when its reading leaves the range between lo and "
            "hi, the flag comes on and all motors freeze. If the limits are left out, every reading of the sensor "
            "is allowed; if s is left out too, the command applies to all sensors."
        ),
         "200 SENSOR 5 -178 450"),
        ("WAND", "[s]", "Assign the wand to sensor s, by default sensor 1. From then on, the flag of this sensor comes "
                       "on if the wand touches something.", "10 WAND"),
    ),
    "data": (
        ("POINT", "", (
            "Holds the positions of 12 motors. DEFPOINT or JOY writes these positions. When POINT is executed, it "
            "does nothing."
        ), "5 POINT"),
    ),
    "arithmetic": (
        ("ADD", "v x", "Add x to variable v.", "50 ADD 1 -1"),
        ("COMPOFF", "", "Set the comparison indicator off.", "10 COMPOFF"),
        ("COMPON", "", "Set the comparison indicator on.", "10 COMPON"),
        ("DADD", "v x [y]", "Add x, or the pair x y, to a pair of variables: v has the high word, and v+1 "
                              "has the low word.",
         "20 DADD 1 500"),
        ("DIVD", "v x [w]", "Divide variable v by x and round toward zero; variable w gets the remainder.",
         "30 DIVD 1 10 2"),
        ("DLOAD", "v x [y]", "Set a pair of variables to x, or to the pair x y: v gets the high word, and "
                               "v+1 gets the low word.",
         "10 DLOAD 1 500"),
        ("EQ?", "x y", "If x equals y, set the comparison indicator on; if not, set it off.", "30 EQ? &1 0"),
        ("GE?", "x y", "If x is at least y, set the comparison indicator on; if not, set it off.", "30 GE? &1 0"),
        ("GET", "v t line word", "Set variable v to a word of table t.", "40 GET 1 MT 3 5"),
        ("GETGOL", "v m", "Set variable v to the goal of motor m.", "40 GETGOL 1 3"),
        ("GETPOS", "v m", "Set variable v to the position of motor m.", "40 GETPOS 1 3"),
        ("GETSEN", "v s", "Set variable v to the reading of sensor s.", "40 GETSEN 1 8"),
        ("GT?", "x y", "If x is greater than y, set the comparison indicator on; if not, set it off.", "30 GT? &1 &2"),
        ("LE?", "x y", "If x is at most y, set the comparison indicator on; if not, set it off.", "30 LE? &1 0"),
        ("LOAD", "v x", "Set variable v to x.", "11 LOAD 1 -&3"),
        ("LT?", "x y", "If x is less than y, set the comparison indicator on; if not, set it off.", "30 LT? &1 0"),
        ("MULT", "v x [w]", "Multiply variable v by x; variable w gets the high word of the product.", "20 MULT 1 25"),
        ("NE?", "x y", "If x differs from y, set the comparison indicator on; if not, set it off.", "30 NE? &1 0"),
        ("OVFLOFF", "", (
            "Set the overflow indicator off. No other statement of a running program clears this indicator."
        ), "10 OVFLOFF"),
        ("OVFLON", "", "Set the overflow indicator on.", "10 OVFLON"),
        ("PUT", "t line word x", "Write a word of a table. The real-time level uses the new value from the next "
        "cycle on.",
         "50 PUT MT 2 8 10"),
    ),
    "edit": (
        ("ERASE", "n1 [n2]", "Erase statement n1; with n2, erase all statements from n1 to n2.", "ERASE 500 550"),
        ("FILE", "t line word x ...", "Write consecutive words of a table.", "FILE MT 2 8 10"),
        ("LIST", "[n1 [n2]]", (
            "List the stored program; with n1, only this statement; with n1 and n2, all statements from n1 to n2."
        ), "LIST 100 200"),
        ("QPOINT", "", "Show the last eight POINTs that DEFPOINT and GOPOINT used, the latest first.", "QPOINT"),
        ("QUERY", "t [line [word]]", "Show a table, a line of the table, or a word of the line.", "QUERY ST 5"),
    ),
    "test": (
        ("TESTAI", "x", "Print analog input x.", "TESTAI 3"),
        ("TESTAO", "x y", "Set analog output x to y. The command checks no limits, so the pump must be off.",
         "TESTAO 3 100"),
        ("TESTDO", "x y [mask]", (
            "Set digital output word x to y. If a mask is given, set only the bits that the mask selects. The pump "
            "must be off."
        ), "TESTDO 1 1"),
    ),
    "host": (
        ("CMSDUMP", "f", "Write the stored program to a file of the host.", "CMSDUMP FOLLOW"),
        ("CMSLOAD", "f", "Replace the stored program by a program from a file of the host.", "CMSLOAD FOLLOW"),
        ("DHAND", "x11 [x12]", "Change the separation of the fingers by x11, and the angle between them by x12.",
         "30 DHAND -50"),
        ("GOLINE", "n1 n2", (
            "Go to a position on the line through two POINTs: the position that is nearest to the present goals."
        ),
         "40 GOLINE 5 10"),
        ("GOMEAN", "n1 n2", "Go to the position halfway between two POINTs.", "40 GOMEAN 5 10"),
        ("GROT", "x [y [z]]", (
            "Rotate the gripper about its own axes by yaw x, pitch y and roll z, in units of .01 degree."
        ),
         "40 GROT 500"),
        ("GTRANS", "x [y [z]]", "Move the gripper along its own axes, in units of .001 inch.", "40 GTRANS 0 0 250"),
        ("QUIT", "", "Close the session with the host.", "QUIT"),
        *((f"UPROC{letter}", "[x ...]", "Call one of the user's procedures on the host.", f"50 UPROC{letter} 1")
          for letter in "ABCD"),
        ("VMCNTL", "", "Start the interpreter of the arm language on the host.", "VMCNTL"),
    ),
}  # fmt: skip

COMMANDS: Final[dict[str, Command]] = {
    code: Command(code=code, category=category, usage=usage, help=help, example=example)
    for category, rows in _ROWS.items()
    for code, usage, help, example in rows
} | {
    name: Command(
        code=name, category="control", usage="[line [word]]", example=name,
        help=f"Show the table {name} ({shape.title}), a line of the table, or a word of the line.",
    )
    for name, shape in SHAPES.items()
}  # fmt: skip
MOTIONS: Final = frozenset(
    (
        "MOVE",
        "DMOVE",
        "MOTOR",
        "DMOTOR",
        "HAND",
        "GOPOINT",
        "JOY",
        "GROT",
        "GTRANS",
        "GOLINE",
        "GOMEAN",
        "DHAND",
    )
)
"""Commands that move the arm. They do nothing while the flag of a sensor is on."""


TABLE_NAMES: Final = {word_of(name): name for name in SHAPES}
"""For each word that stands for a table, the name of the table. The word consists of the two letters of the name, with
8 bits for each letter.
"""


def explained(word: str) -> str | None:
    """Return the help of the command called `word`, or None if no command has this name."""
    command = COMMANDS.get(word.upper())
    if command is None:
        return None
    return f"{command.form}\n\n{command.help}\n\nfor example: {command.example}\n{command.category} command of ML"
