"""The words of MAL: the table that parser, completion, `explain` and the page of words are made from."""

from typing import Final, Literal, NamedTuple

from handeye.systems.sigma.protocol import AXES, DEVICES

Kind = Literal["statement", "part", "function", "operator"]


class Word(NamedTuple):
    """A word of the language."""

    kind: Kind
    usage: str
    help: str
    example: str = ""


WORDS: Final[dict[str, Word]] = {
    "REM": Word("statement", "REM text", "A remark; nothing is done.", "10 REM FEED FOUR PIECES"),
    "LET": Word(
        "statement", "[LET] name = expression", "Set a variable. Those that were never set hold 0.",
        "10 PIECES = PIECES + 1",
    ),
    "IF": Word(
        "statement", "IF condition THEN target [ELSE target]",
        "Go to a line, or execute a statement, if a condition holds.", "10 IF BEAM(1) = 0 THEN 110",
    ),
    "GOTO": Word("statement", "GOTO line", "Go to a line of the same task.", "10 GOTO 200"),
    "GOSUB": Word("statement", "GOSUB line", "Go to a subroutine; RETURN comes back.", "10 GOSUB 500"),
    "RETURN": Word("statement", "RETURN", "Go back behind the last GOSUB.", "570 RETURN"),
    "FOR": Word(
        "statement", "FOR name = expression TO expression [STEP expression]",
        "Repeat the lines to NEXT for each value. The lines are executed at least once.", "10 FOR I = 1 TO 4",
    ),
    "NEXT": Word("statement", "NEXT name", "The end of the lines that FOR repeats.", "90 NEXT I"),
    "PRINT": Word(
        "statement", "PRINT [item {(,|;) item}]",
        "Print texts and numbers: `,` begins the next zone of 14 columns, `;` none. At its end they keep a line open.",
        '60 PRINT "PIECES", PIECES',
    ),
    "INPUT": Word("statement", "INPUT name", "Wait for a number from the console.", "10 INPUT HEIGHT"),
    "STOP": Word("statement", "STOP", "End the program: all its tasks.", "90 STOP"),
    "END": Word("statement", "END", "End this task. The program ends with its last task.", "70 END"),
    "TASK": Word(
        "statement", "TASK name",
        "The lines behind it are those of a task. Lines before the first TASK are the task MAIN.", "100 TASK FEEDER",
    ),
    "START": Word("statement", "START task {, task}", "Start tasks, beside this one.", "40 START FEEDER, SCREWER"),
    "KILL": Word(
        "statement", "KILL task {, task}", "End tasks. A motion that one has under way goes on to its end.",
        "90 KILL FEEDER",
    ),
    "SET": Word("statement", "SET flag", "Set a flag. To set it twice is to set it once.", "220 SET PARTREADY"),
    "RESET": Word("statement", "RESET flag", "Clear a flag.", "90 RESET PARTREADY"),
    "WAIT": Word(
        "statement", "WAIT flag {AND flag}", "Wait until all these flags are set, and leave them set.",
        "50 WAIT FEEDERDONE AND SCREWERDONE",
    ),
    "TAKE": Word(
        "statement", "TAKE flag", "Wait until a flag is set, and clear it in the same act: only one task gets it.",
        "160 TAKE PLACEFREE",
    ),
    "DELAY": Word("statement", "DELAY expression", "Wait for a time, in seconds.", "10 DELAY 0.5"),
    "MOVE": Word(
        "statement", "MOVE axis (TO|BY) expression {, axis (TO|BY) expression} [SLOW expression|LINE] [NOWAIT]",
        "Move axes to places, or by distances, mm: one command each in the order written, then wait for all of them. "
        "They move together and do not wait for each other.",
        "10 MOVE X1 TO 300, Y1 TO 150",
    ),
    "ORIGIN": Word(
        "statement", "ORIGIN axis {, axis}", "Search the ends of the rails, all at once, and count from there.",
        "20 ORIGIN X1, Y1, Z1",
    ),
    "SPEED": Word("statement", "SPEED axis, expression", "Limit the speed of an axis, mm/s; 0: no limit.",
                  "10 SPEED X1, 100"),
    "CURVE": Word(
        "statement", "CURVE axis, expression",
        "Choose how an axis accelerates: 0 usual, 1 to 562.5 mm/s, 2 half as fast, 3 a quarter, 4 from half the "
        "start speed.",
        "10 CURVE Z1, 2",
    ),
    "LIMIT": Word(
        "statement", "LIMIT axis, (expression|STANDARD)",
        "Set the force, N, above which the axis is stopped; STANDARD: the usual one.", "10 LIMIT Z2, 25",
    ),
    "ACTUATE": Word(
        "statement", "ACTUATE device [= expression]", "Set a device, to 1 if nothing is said, and wait for it.",
        "50 ACTUATE HAND1 = 0",
    ),
    "ON": Word(
        "statement", "ON ABORT [axis] GOTO line",
        "If a motion of this task is aborted, on any axis or this one, go to a line.", "10 ON ABORT GOTO 900",
    ),
    "RESUME": Word("statement", "RESUME", "Go on behind the MOVE that was aborted.", "920 RESUME"),
    "THEN": Word("part", "THEN (line|statement)", "What to do if the condition of IF holds."),
    "ELSE": Word("part", "ELSE (line|statement)", "What to do if it does not."),
    "TO": Word("part", "axis TO expression", "In MOVE: the place, mm. In FOR: the last value."),
    "BY": Word("part", "axis BY expression", "The distance, mm."),
    "STEP": Word("part", "STEP expression", "In FOR: by how much the value grows; 1 if nothing is said."),
    "SLOW": Word("part", "SLOW expression", "Move at this constant speed, 2 to 254 mm/s."),
    "LINE": Word("part", "LINE", "Choose constant speeds with which all axes arrive together: a straight path."),
    "NOWAIT": Word("part", "NOWAIT", "Go on as soon as the commands are sent."),
    "STANDARD": Word("part", "STANDARD", "The force limit that the machine has by itself."),
    "ABORT": Word("part", "ON ABORT", "A motor was stopped: at the end of its rail, or by a force."),
    "ABS": Word("function", "ABS(expression)", "The value without its sign."),
    "INT": Word("function", "INT(expression)", "The largest whole number that is not larger."),
    "SGN": Word("function", "SGN(expression)", "1, 0 or -1, by the sign."),
    "SQR": Word("function", "SQR(expression)", "The square root."),
    "POS": Word("function", "POS(axis)", "Where the axis was sent, mm; the computer counts it, nothing is asked."),
    "FORCE": Word("function", "FORCE(axis)", "The force on the wrist along the axis, N; asks the force microcomputer."),
    "CRASHPOS": Word("function", "CRASHPOS(axis)", "Where the axis was when it was last aborted, mm; asks the motor."),
    "STATUS": Word("function", "STATUS(axis)", "0 free, 1 busy, 2 stopped at its rail, 3 stopped by a force."),
    "BEAM": Word("function", "BEAM(arm)", "1 if the light beam of the arm's hand is cut, 0 if not; asks the hand."),
    "TIME": Word("function", "TIME", "Seconds since the program began."),
    "NOT": Word("operator", "NOT condition", "The condition does not hold."),
    "AND": Word("operator", "condition AND condition", "Both hold. In WAIT: all these flags."),
    "OR": Word("operator", "condition OR condition", "One of them holds, or both."),
}  # fmt: skip
STATEMENTS: Final = tuple(name for name, word in WORDS.items() if word.kind == "statement")
FUNCTIONS: Final = tuple(name for name, word in WORDS.items() if word.kind == "function")
MAL_DEVICES: Final[dict[str, tuple[int, str]]] = {
    "HAND1": (1, "HAND"),
    "HAND2": (2, "HAND"),
    "DRIVER2": (2, "DRIVER"),
    "LAMP": (1, "LAMP"),
    "BELL": (1, "BELL"),
}
"""The arm whose hand microcomputer works a device, and the device's name there."""
assert {device for _, device in MAL_DEVICES.values()} == {*DEVICES}
RESERVED: Final = {*WORDS, *AXES, "DIM"}
"""Words that no variable, flag or task can be called."""


def explained(word: str) -> str | None:
    """What a word means, with an example; None if it is none of MAL's."""
    known = WORDS.get(word.upper())
    if known is None:
        return None
    example = f"\n\nfor example\n\n    {known.example}" if known.example else ""
    return f"{known.usage}\n\n{known.help}{example}"
