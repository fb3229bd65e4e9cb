"""The table of all kinds of mistakes in ML programs. Each kind has a code, an example text and a cure."""

from typing import Final

from handeye.program.mistakes import Mistake, Mistakes

CODES: Final[dict[str, Mistake]] = {
    "M01": Mistake(
        meaning="a command does not exist", example="10 MOOVE 0 0 2000",
        cure="`handeye ml words` lists the commands",
    ),
    "M02": Mistake(
        meaning="a sequence number is not between 1 and 5000", example="5001 STOP",
        cure="give each statement a number from 1 to 5000",
    ),
    "M03": Mistake(
        meaning="a command has too few or too many parameters", example="10 MOTOR 3",
        cure="`handeye ml words COMMAND` shows the parameters of a command",
    ),
    "M04": Mistake(
        meaning="a number does not fit into 16 bits, or the limits of a sensor are in the wrong order",
        example="10 LOAD 1 32768", cure="use numbers from -32768 to 32767, and give the lower limit first",
    ),
    "M05": Mistake(
        meaning="the number of a variable is not between 1 and 256", example="10 LOAD 3 &257",
        cure="use `&1` to `&256`",
    ),
    "M06": Mistake(
        meaning="a reference has more than six `&`", example="10 BRANCH &&&&&&&17",
        cure="first load a part of the chain of references into a variable",
    ),
    "M07": Mistake(
        meaning="the program refers to a statement that does not exist", example="10 BRANCH 700\n20 STOP",
        cure="give the number of a stored statement",
    ),
    "M08": Mistake(
        meaning="the program refers to a point that does not exist", example="10 GOPOINT 5\n20 STOP",
        cure="store a POINT statement under this number",
    ),
    "M09": Mistake(
        meaning="a motor is not installed", example="10 MOTOR 6 100",
        cure="use motors 1 to 4 and 8 to 12 of the right arm, or 2 to 4 and 8 to 11 of the left arm; give 0 for absent "
        "motors in MOVE and DMOVE",
    ),
    "M10": Mistake(
        meaning="a goal is outside the travel of its motor", example="10 MOTOR 3 12000",
        cure="words 6 and 7 of each line of the table MT give the travel of a motor",
    ),
    "M11": Mistake(
        meaning="a sensor or a table, or a line or word of a table, does not exist", example="10 GET 1 MT 13 1",
        cure="`QUERY` shows a table; `handeye ml words` lists all tables",
    ),
    "M13": Mistake(
        meaning="a NEXTI has no LOOPI, a NEXTJ has no LOOPJ, or a RETURN has no GOSUB",
        example="10 NEXTI",
        cure="write LOOPI before NEXTI, and LOOPJ before NEXTJ; use GOSUB to call a subroutine that ends with RETURN",
    ),
    "bad-parameter": Mistake(
        meaning="a parameter has a form that its command does not accept", example="10 LOAD 1 ABC",
        cure="write a number such as `-100`, or a reference such as `&17` or `-&17`",
    ),
    "flag-left-on": Mistake(
        meaning="a flag is still on after a BRANCH has tested it, and no SENSOR clears the flag, so the next motion "
        "moves nothing",
        example="10 SENSOR 5 -178 450\n20 DMOTOR 2 100\n30 BRANCH 40 50 5\n40 DMOTOR 2 -100\n50 STOP",
        cure="clear the flag with SENSOR before the motion", severity="warning",
    ),
    "limits-empty": Mistake(
        meaning="no reading can be strictly between the two limits of a SENSOR, so the flag comes on at once",
        example="10 SENSOR 1 0 1\n20 STOP",
        cure="a reading that is equal to a limit counts as outside; to accept 0, write `SENSOR 1 -1 1`",
        severity="warning",
    ),
    "line-replaced": Mistake(
        meaning="two lines have the same sequence number, and the second replaces the first",
        example="10 LOAD 1 5\n10 LOAD 1 6", cure="give each line a different number", severity="warning",
    ),
    "long-line": Mistake(
        meaning="a line has more than 500 characters", example=f"10 PRINT{' ' * 500}1", cure="remove blanks",
    ),
    "loop-without-end": Mistake(
        meaning="a LOOPI has no NEXTI after it, or a LOOPJ has no NEXTJ after it", example="10 LOOPI 3\n20 ADD 1 1",
        cure="write NEXTI or NEXTJ after the statements to repeat",
    ),
    "not-stored": Mistake(
        meaning="a line of a program file has no sequence number", example="MOTOR 3 2000",
        cure="give the line a number; `handeye ml` executes lines without a number immediately",
    ),
    "point-not-filled": Mistake(
        meaning="the arm goes to a POINT that no statement fills with positions", example="5 POINT\n10 GOPOINT 5",
        cure="fill the point with DEFPOINT or JOY, or give its positions: `5 POINT * 0 0 2000 ...`", severity="warning",
    ),
    "too-fast": Mistake(
        meaning="a motion starts so fast that the jolt trips the limit of a finger's strain gauge",
        example="10 SENSOR 7 -60 60\n20 DMOTOR 2 500\n30 SENSOR\n40 STOP",
        cure="before the motion, lower the speed with `PUT MT m 8 x`, or widen the limits", severity="warning",
    ),
    "unguarded-motion": Mistake(
        meaning="no sensor has limits during a motion, so nothing guards the motion",
        example="10 DMOTOR 2 -100\n20 STOP",
        cure="write a SENSOR with limits before the motion", severity="warning",
    ),
}  # fmt: skip

SYMBOLIC: Final[dict[str, Mistake]] = {
    "bad-definition": Mistake(
        meaning="a definition with EQU or VAR has the wrong form", example="STEP EQU",
        cure="write `NAME EQU number`, or `NAME VAR`",
    ),
    "bad-name": Mistake(
        meaning="a name is already the name of a command or a table, or contains characters other than letters, "
        "digits and `_`",
        example="STOP EQU 5", cure="choose another name; it must begin with a letter",
    ),
    "name-twice": Mistake(
        meaning="a name is defined twice", example="A EQU 5\nA VAR", cure="give each value a different name",
    ),
    "too-many-statements": Mistake(
        meaning="a symbolic program has more than 1000 statements", example="STOP\n" * 1001,
        cure="write repeated statements only once, as a subroutine, and call it with GOSUB",
    ),
    "unknown-name": Mistake(
        meaning="a symbolic program uses a name that it does not define", example="BRANCH AGAIN",
        cure="define the name with EQU or VAR, or as a label",
    ),
}  # fmt: skip
"""Mistakes that only a symbolic program can have. A symbolic program can also have each mistake that a program in ML
can have.
"""

mistake: Final = Mistakes(CODES, SYMBOLIC)
"""Makes a diagnostic of ML."""
