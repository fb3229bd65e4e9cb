"""All kinds of mistakes in MAL programs, by code, each with an example text and a cure."""

from typing import Final

from handeye.core.codes import Severity
from handeye.core.diagnostics import Diagnostic, KnownNames, Label, SimilarName, names_sentence, problem
from handeye.core.record import Record
from handeye.core.source import Span


class MalCode(Record, frozen=True, kw_only=True):
    """A kind of mistake."""

    meaning: str
    example: str
    cure: str
    severity: Severity = "error"


CODES: Final[dict[str, MalCode]] = {
    "arrays-dropped": MalCode(
        meaning="MAL has no arrays", example="10 A(1) = 5", cure="use a variable for each value: `A1 = 5`"
    ),
    "axis-shared": MalCode(
        meaning="two tasks move one axis",
        example="10 START OTHER\n20 MOVE X1 TO 5\n30 TASK OTHER\n40 MOVE X1 TO 9",
        cure="let one task move an axis, or hand the axis over by flags; "
        "`handeye sigma check FILE --interleavings` tries all orders",
        severity="warning",
    ),
    "axis-twice": MalCode(
        meaning="a statement names one axis twice", example="10 MOVE X1 TO 5, X1 TO 9",
        cure="write two statements, one after the other",
    ),
    "beyond-rail": MalCode(
        meaning="a place is beyond the end of a rail", example="10 MOVE Z1 TO 300",
        cure="stay within 0 and 600 mm in X, 400 in Y, 200 in Z", severity="warning",
    ),
    "flag-never-set": MalCode(
        meaning="a task waits for a flag that no line sets", example="10 WAIT READY",
        cure="SET the flag in another task, or correct its name", severity="warning",
    ),
    "for-without-next": MalCode(
        meaning="no NEXT of the same name follows a FOR in its task", example="10 FOR I = 1 TO 4\n20 PRINT I",
        cure="write NEXT after the lines that are repeated",
    ),
    "line-missing": MalCode(
        meaning="a jump leads to a line that does not exist", example="10 GOTO 25\n20 END",
        cure="name a line of this task",
    ),
    "line-number": MalCode(
        meaning="a line does not begin with a number from 1 to 99999", example='PRINT "READY"',
        cure="begin each line with its number",
    ),
    "long-line": MalCode(
        meaning="a line has more than 500 characters", example=f'10 PRINT "{"A" * 500}"', cure="write several lines",
    ),
    "line-twice": MalCode(
        meaning="two lines have one number", example="10 PRINT 1\n10 PRINT 2",
        cure="give each line a different number",
    ),
    "next-without-for": MalCode(
        meaning="no FOR of the same name is before a NEXT in its task", example="10 PRINT I\n20 NEXT I",
        cure="write FOR before the lines that are repeated",
    ),
    "number-too-large": MalCode(
        meaning="a number is beyond 1e30", example="10 A = 1E99", cure="use a smaller number"
    ),
    "option-twice": MalCode(
        meaning="a MOVE has one option twice, or two that exclude each other",
        example="10 MOVE X1 TO 5 SLOW 4 LINE", cure="keep one of them",
    ),
    "other-task": MalCode(
        meaning="a jump leads into another task",
        example="10 START FEEDER\n20 GOTO 40\n30 TASK FEEDER\n40 END",
        cure="jump within the task; START begins another one",
    ),
    "reserved-word": MalCode(
        meaning="a name is a word of the language", example="10 SPEED = 5", cure="use another name, such as `SPEED1`"
    ),
    "resume-without-abort": MalCode(
        meaning="a task has RESUME and no ON ABORT", example="10 RESUME", cure="write ON ABORT GOTO before it"
    ),
    "return-without-gosub": MalCode(
        meaning="a task has RETURN and no GOSUB", example="10 RETURN",
        cure="call the lines by GOSUB, or end them with END",
    ),
    "stray-character": MalCode(
        meaning="a character has no meaning in MAL", example="10 A = 5 % 2", cure="take it out; remarks begin with REM"
    ),
    "syntax": MalCode(
        meaning="a statement is not written as its form says", example="10 MOVE X1 50",
        cure="`handeye sigma words MOVE` shows the form of a statement",
    ),
    "task-missing": MalCode(
        meaning="START or KILL names no task of the program", example="10 START FEDER\n20 TASK FEEDER\n30 END",
        cure="name a task that a TASK line begins",
    ),
    "task-never-started": MalCode(
        meaning="no line starts a task", example="10 END\n20 TASK FEEDER\n30 END", cure="START it",
        severity="warning",
    ),
    "task-twice": MalCode(
        meaning="two tasks have one name", example="10 START A\n20 TASK A\n30 TASK A\n40 END",
        cure="give each a different name; the first lines are the task MAIN",
    ),
    "text-unclosed": MalCode(
        meaning="a text has no second quotation mark", example='10 PRINT "READY', cure='end it with `"`'
    ),
    "too-deep": MalCode(
        meaning="an expression or a statement is nested more than 30 deep",
        example=f"10 A = {'(' * 40}1{')' * 40}", cure="put a part of it into a variable",
    ),
    "too-many-lines": MalCode(
        meaning="a program has more than 5000 lines", example="\n".join(f"{n} END" for n in range(1, 5002)),
        cure="use GOSUB for lines that are repeated",
    ),
    "unknown-statement": MalCode(
        meaning="a line begins with no statement of MAL", example="10 MOOVE X1 TO 5",
        cure="`handeye sigma words` lists the statements",
    ),
    "variable-never-set": MalCode(
        meaning="a variable is read that no line sets: it holds 0", example="10 HEIGHT = 5\n20 PRINT HIGHT",
        cure="set it first, or correct its name", severity="warning",
    ),
    "wrong-value": MalCode(
        meaning="a number that a statement does not take", example="10 CURVE X1, 7",
        cure="`handeye sigma words CURVE` says what a statement takes",
    ),
}  # fmt: skip


def mistake(
    code: str,
    message: str,
    span: Span,
    *secondary: Label,
    help: str | None = None,
    meant: SimilarName | KnownNames | None = None,
) -> Diagnostic:
    """A diagnostic with the cure of its code, unless there is a more specific one."""
    known = CODES[code]
    cure = help or names_sentence(meant) or known.cure
    return problem(code, message, span, *secondary, help=cure, meant=meant, own=known.severity)
