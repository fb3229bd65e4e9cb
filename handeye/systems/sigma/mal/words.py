"""The table of the words of MAL. The parser, completion, `explain` and the page of words are derived from this
table.
"""

from typing import Final, Literal, NamedTuple

from handeye.systems.sigma.protocol import DEVICES, LINE_AXES

Kind = Literal["statement", "part", "function", "operator"]


class Word(NamedTuple):
    """A word of MAL."""

    kind: Kind
    usage: str
    help: str
    example: str = ""


WORDS: Final[dict[str, Word]] = {
    "REM": Word("statement", "REM text", "A remark, which has no effect.", "10 REM FEED FOUR PIECES"),
    "LET": Word(
        "statement", "[LET] name = expression", "Set a variable. A variable that was never set holds 0.",
        "10 PIECES = PIECES + 1",
    ),
    "IF": Word(
        "statement", "IF condition THEN target [ELSE target]",
        "Go to a line, or execute a statement, if a condition holds.", "10 IF BEAM(1) = 0 THEN 110",
    ),
    "GOTO": Word("statement", "GOTO line", "Go to a line of the same task.", "10 GOTO 200"),
    "GOSUB": Word(
        "statement", "GOSUB line", "Go to a subroutine; its RETURN goes back to the line after GOSUB.", "10 GOSUB 500",
    ),
    "RETURN": Word(
        "statement", "RETURN", "Go back to the line after the GOSUB that called the subroutine.", "570 RETURN",
    ),
    "FOR": Word(
        "statement", "FOR name = expression TO expression [STEP expression]",
        "Repeat the lines up to NEXT, once for each value of the variable. The lines run at least once.",
        "10 FOR I = 1 TO 4",
    ),
    "NEXT": Word("statement", "NEXT name", "The end of the lines that FOR repeats.", "90 NEXT I"),
    "PRINT": Word(
        "statement", "PRINT [item {(,|;) item}]",
        "Print texts and numbers. After `,`, the next item begins in the next zone of 14 columns; after `;`, it "
        "follows directly. If the statement ends with `,` or `;`, the next PRINT continues the same line.",
        '60 PRINT "PIECES", PIECES',
    ),
    "INPUT": Word("statement", "INPUT name", "Wait for a number from the console.", "10 INPUT HEIGHT"),
    "STOP": Word(
        "statement", "STOP [text]",
        "End the program with all its tasks. With a text, the program counts as failed, and the text says why.",
        '90 STOP "NO PIECE IS FOUND"',
    ),
    "END": Word("statement", "END", "End this task. The program ends when its last task ends.", "70 END"),
    "TASK": Word(
        "statement", "TASK name",
        "Begin a task: the lines that follow belong to it. Lines before the first TASK belong to the task MAIN.",
        "100 TASK FEEDER",
    ),
    "START": Word(
        "statement", "START task {, task}",
        "Start tasks, which then run at the same time as this task.",
        "40 START FEEDER, SCREWER",
    ),
    "KILL": Word(
        "statement", "KILL task {, task}",
        "End tasks. A motion that one of these tasks has begun continues to its end.",
        "90 KILL FEEDER",
    ),
    "SET": Word("statement", "SET flag", (
        "Set a flag. If the flag is already set, SET has no effect."
    ), "220 SET PARTREADY"),
    "RESET": Word("statement", "RESET flag", "Clear a flag.", "90 RESET PARTREADY"),
    "WAIT": Word(
        "statement", "WAIT flag {AND flag}", "Wait until all these flags are set, and leave them set.",
        "50 WAIT FEEDERDONE AND SCREWERDONE",
    ),
    "TAKE": Word(
        "statement", "TAKE flag",
        "Wait until a flag is set, and clear the flag in the same statement, so that only one task takes it.",
        "160 TAKE PLACEFREE",
    ),
    "DELAY": Word("statement", "DELAY expression", "Wait for a time, in seconds.", "10 DELAY 0.5"),
    "MOVE": Word(
        "statement", "MOVE axis (TO|BY) expression {, axis (TO|BY) expression} [SLOW expression|LINE] [NOWAIT]",
        "Move axes to positions, or by distances (both in mm). Each axis gets one command, in the order of the text; "
        "the axes move at the same time, each at its own speed. Without NOWAIT, the statement ends when all axes have "
        "stopped.",
        "10 MOVE X1 TO 300, Y1 TO 150",
    ),
    "ORIGIN": Word(
        "statement", "ORIGIN axis {, axis}",
        "Move axes to the low ends of their rails, all at the same time, and count from these ends. If an axis has "
        "lost steps since its last ORIGIN, the program stops.",
        "20 ORIGIN X1, Y1, Z1",
    ),
    "SPEED": Word("statement", "SPEED axis, expression", "Limit the speed of an axis (in mm/s); 0 means no limit.",
                  "10 SPEED X1, 100"),
    "CURVE": Word(
        "statement", "CURVE axis, expression",
        "Choose the curve by which an axis accelerates. Curve 0 is the usual one, with a top speed of 500 mm/s. "
        "Curve 1 has a top speed of 562.5 mm/s. Curve 2 accelerates half as fast as curve 0, and curve 3 a quarter "
        "as fast. Curve 4 has half the start/stop speed of curve 0.",
        "10 CURVE Z1, 2",
    ),
    "LIMIT": Word(
        "statement", "LIMIT axis, (expression|STANDARD)",
        "Set the force (in N) above which the axis stops; STANDARD restores the standard limit of the machine.",
        "10 LIMIT Z2, 25",
    ),
    "ACTUATE": Word(
        "statement", "ACTUATE device [= expression]",
        "Set a device to a value (1 if the value is left out), and wait until the device has finished.",
        "50 ACTUATE HAND1 = 0",
    ),
    "ON": Word(
        "statement", "ON ABORT [axis] GOTO line",
        "Go to a line if a motion of this task is aborted on the named axis. Without an axis, the statement is for "
        "all axes.",
        "10 ON ABORT GOTO 900",
    ),
    "RESUME": Word("statement", "RESUME", "Continue after the MOVE that was aborted.", "920 RESUME"),
    "THEN": Word("part", "THEN (line|statement)", "What to do if the condition of IF holds."),
    "ELSE": Word("part", "ELSE (line|statement)", "What to do if the condition of IF does not hold."),
    "TO": Word("part", "axis TO expression", "In MOVE: the position, in mm. In FOR: the last value."),
    "BY": Word("part", "axis BY expression", "The distance, in mm."),
    "STEP": Word("part", "STEP expression", "In FOR: by how much the value grows each time; 1 if STEP is left out."),
    "SLOW": Word("part", "SLOW expression", "Move at this constant speed, 2 to 254 mm/s."),
    "LINE": Word(
        "part", "LINE",
        "Move each axis at a constant speed, so that all axes arrive together and the path is straight.",
    ),
    "NOWAIT": Word("part", "NOWAIT", "Continue as soon as the commands are sent; do not wait for the motion."),
    "STANDARD": Word("part", "STANDARD", "In LIMIT: the force limit that applies before the program sets any LIMIT."),
    "ABORT": Word("part", "ON ABORT", "An abort means that a motor was stopped by a force or at the end of its rail."),
    "ABS": Word("function", "ABS(expression)", "The value without its sign."),
    "INT": Word("function", "INT(expression)", "The largest whole number that does not exceed the value."),
    "SGN": Word("function", "SGN(expression)", "1, 0 or -1, for a positive value, zero, or a negative value."),
    "SQR": Word("function", "SQR(expression)", "The square root."),
    "POS": Word(
        "function", "POS(axis)",
        "The position (in mm) to which the axis was sent. The computer knows this position from its own commands, "
        "without asking the motor.",
    ),
    "FORCE": Word(
        "function", "FORCE(axis)",
        "The force (in N) on the wrist along the axis, as the force microcomputer reports it.",
    ),
    "CRASHPOS": Word(
        "function", "CRASHPOS(axis)",
        "The position (in mm, reported by the motor) at which a motion of the axis was last aborted.",
    ),
    "STATUS": Word("function", "STATUS(axis)", "The state of the axis: 0 free, 1 busy, 2 stopped at the end "
    "of its rail, 3 stopped by a force."),
    "BEAM": Word(
        "function", "BEAM(arm)",
        "The answer of the arm's hand: 1 if an object breaks the light beam of the hand, 0 if not.",
    ),
    "TIME": Word("function", "TIME", "Seconds since the program began."),
    "NOT": Word("operator", "NOT condition", "True if the condition does not hold."),
    "AND": Word(
        "operator", "condition AND condition",
        "True if both conditions hold. In WAIT, between flags: wait until all of them are set.",
    ),
    "OR": Word("operator", "condition OR condition", "True if at least one of the conditions holds."),
}  # fmt: skip
STATEMENTS: Final = tuple(name for name, word in WORDS.items() if word.kind == "statement")
FUNCTIONS: Final = tuple(name for name, word in WORDS.items() if word.kind == "function")
MAL_DEVICES: Final[dict[str, tuple[int, str]]] = {
    "HAND1": (1, "HAND"),
    "HAND2": (2, "HAND"),
    "HAND3": (3, "HAND"),
    "HAND4": (4, "HAND"),
    "DRIVER2": (2, "DRIVER"),
    "LAMP": (1, "LAMP"),
    "BELL": (1, "BELL"),
}
"""For each device: the number of the arm whose hand microcomputer drives the device, and the device's name in this
microcomputer.
"""
assert {device for _, device in MAL_DEVICES.values()} == {*DEVICES}
RESERVED: Final = {*WORDS, *LINE_AXES, "DIM"}
"""Words that cannot be names of variables, flags or tasks."""


def explained(word: str) -> str | None:
    """Return the meaning of a MAL word, followed by an example. Return None for a word that MAL does not have."""
    known = WORDS.get(word.upper())
    if known is None:
        return None
    example = f"\n\nfor example\n\n    {known.example}" if known.example else ""
    return f"{known.usage}\n\n{known.help}{example}"
