"""The table of all kinds of mistakes in MAL programs. Each kind has a code, an example text and a cure."""

from typing import Final

from handeye.program.mistakes import Mistake, Mistakes

CODES: Final[dict[str, Mistake]] = {
    "arrays-dropped": Mistake(
        meaning="MAL has no arrays", example="10 A(1) = 5", cure="use a variable for each value: `A1 = 5`"
    ),
    "axis-shared": Mistake(
        meaning="two tasks move the same axis",
        example="10 START OTHER\n20 MOVE X1 TO 5\n30 TASK OTHER\n40 MOVE X1 TO 9",
        cure="move each axis in only one task, or use flags to pass the axis from task to task; `handeye sigma "
        "check FILE --interleavings` tries every order in which the tasks can run",
        severity="warning",
    ),
    "axis-twice": Mistake(
        meaning="a statement names the same axis twice", example="10 MOVE X1 TO 5, X1 TO 9",
        cure="write two statements, one after the other",
    ),
    "beyond-rail": Mistake(
        meaning="a goal is beyond the end of a rail", example="10 MOVE Z1 TO 300",
        cure="choose goals from 0 to 600 mm for X, 0 to 400 mm for Y and 0 to 200 mm for Z", severity="warning",
    ),
    "flag-never-set": Mistake(
        meaning="a task waits for a flag that no line sets", example="10 WAIT READY",
        cure="set the flag with SET in another task, or correct the name of the flag", severity="warning",
    ),
    "for-without-next": Mistake(
        meaning="a FOR has no later NEXT with the same variable in the same task",
        example="10 FOR I = 1 TO 4\n20 PRINT I",
        cure="write NEXT after the lines to repeat",
    ),
    "line-missing": Mistake(
        meaning="a jump leads to a line that does not exist", example="10 GOTO 25\n20 END",
        cure="give the number of a line of the same task",
    ),
    "line-number": Mistake(
        meaning="a line does not begin with a number from 1 to 99999", example='PRINT "READY"',
        cure="begin each line with its number",
    ),
    "long-line": Mistake(
        meaning="a line has more than 500 characters", example=f'10 PRINT "{"A" * 500}"',
        cure="split the line into several lines",
    ),
    "line-twice": Mistake(
        meaning="two lines have the same number", example="10 PRINT 1\n10 PRINT 2",
        cure="give each line a different number",
    ),
    "next-without-for": Mistake(
        meaning="a NEXT has no earlier FOR with the same variable in the same task", example="10 PRINT I\n20 NEXT I",
        cure="write FOR before the lines to repeat",
    ),
    "number-too-large": Mistake(
        meaning="a number is beyond 1e30", example="10 A = 1E99", cure="use a smaller number"
    ),
    "option-twice": Mistake(
        meaning="a MOVE has the same option twice, or two options that exclude each other",
        example="10 MOVE X1 TO 5 SLOW 4 LINE", cure="keep one of the two options",
    ),
    "other-task": Mistake(
        meaning="a jump leads into another task",
        example="10 START FEEDER\n20 GOTO 40\n30 TASK FEEDER\n40 END",
        cure="jump only to lines of the same task; to start another task, use START",
    ),
    "reserved-word": Mistake(
        meaning="a name is the same as a word of the language", example="10 SPEED = 5",
        cure="use another name, such as `SPEED1`",
    ),
    "resume-without-abort": Mistake(
        meaning="a task has RESUME but no ON ABORT", example="10 RESUME", cure="write ON ABORT GOTO before RESUME"
    ),
    "return-without-gosub": Mistake(
        meaning="a task has RETURN but no GOSUB", example="10 RETURN",
        cure="call the lines before RETURN with GOSUB, or replace RETURN with END",
    ),
    "stray-character": Mistake(
        meaning="a character has no meaning in MAL", example="10 A = 5 % 2",
        cure="delete the character; remarks begin with REM"
    ),
    "syntax": Mistake(
        meaning="a statement does not have the form that its word requires", example="10 MOVE X1 50",
        cure="`handeye sigma words WORD` shows the form of a statement",
    ),
    "task-missing": Mistake(
        meaning="START or KILL names a task that the program does not have",
        example="10 START FEDER\n20 TASK FEEDER\n30 END",
        cure="give the name of a task that has a TASK line",
    ),
    "task-never-started": Mistake(
        meaning="a task is never started", example="10 END\n20 TASK FEEDER\n30 END",
        cure="start the task with START, or delete its lines",
        severity="warning",
    ),
    "task-twice": Mistake(
        meaning="two tasks have the same name", example="10 START A\n20 TASK A\n30 TASK A\n40 END",
        cure="give each task a different name; the lines before the first TASK line are the task MAIN",
    ),
    "text-unclosed": Mistake(
        meaning="a text has no second quotation mark", example='10 PRINT "READY', cure='end the text with `"`'
    ),
    "too-deep": Mistake(
        meaning="an expression or a statement is nested more than 30 deep",
        example=f"10 A = {'(' * 40}1{')' * 40}", cure="assign a part of the expression to a variable first",
    ),
    "too-many-lines": Mistake(
        meaning="a program has more than 5000 lines", example="\n".join(f"{n} END" for n in range(1, 5002)),
        cure="write repeated lines only once, as a subroutine, and call it with GOSUB",
    ),
    "unknown-statement": Mistake(
        meaning="a line does not begin with a statement of MAL", example="10 MOOVE X1 TO 5",
        cure="`handeye sigma words` lists the statements",
    ),
    "variable-never-set": Mistake(
        meaning="the program reads a variable that no line sets, so the value is 0",
        example="10 HEIGHT = 5\n20 PRINT HIGHT",
        cure="set the variable first, or correct its name", severity="warning",
    ),
    "wrong-value": Mistake(
        meaning="a statement has a number outside its allowed range", example="10 CURVE X1, 7",
        cure="`handeye sigma words WORD` says which values a statement allows",
    ),
}  # fmt: skip

mistake: Final = Mistakes(CODES)
"""Makes a diagnostic of MAL."""
