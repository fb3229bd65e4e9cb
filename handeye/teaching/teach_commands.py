"""The table of the commands for teaching. The parser and the help use this table."""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Final

import numpy as np

from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadArgument, HandeyeError, NoSuchName, Refused
from handeye.core.pose import Array
from handeye.core.record import Vector3
from handeye.core.units import DEGREE, INCH, OUNCE_FORCE
from handeye.debugger.command import Command, rows
from handeye.debugger.views import show
from handeye.program.program import Position
from handeye.teaching.answers import Answer, answer
from handeye.teaching.teacher import Teacher

AXES: Final = ("x", "y", "z")
NAME: Final = re.compile(r"[A-Za-z_]\w*", re.ASCII)
MAX_PUSH_S: Final = 60.0


@dataclass(slots=True)
class TeachSession:
    """Parses the lines that a user types, and executes them with the arm."""

    teacher: Teacher
    over: bool = False
    warned: bool = False  # the user was warned of unsaved names

    def hear(self, line: str) -> Answer:
        """Execute a line. An invalid line changes nothing."""
        try:
            given = self._given(line.split())
        except HandeyeError as error:
            given = answer(self.teacher.workplace, error=str(error))
        return replace(given, typed=line.strip())

    def _given(self, words: list[str]) -> Answer:
        if not words:
            return answer(self.teacher.workplace)
        word, rest = words[0].lower(), words[1:]
        if word in ("quit", "exit"):
            return self._quit()
        self.warned = False
        joint = re.fullmatch(r"j([1-9]\d?)", word)
        if joint is not None and int(joint[1]) <= len(self.teacher.workplace.run.arm.joints):
            return _joint(self.teacher, [joint[1], *rest])
        lesson = TEACH_COMMANDS.get(word)
        if lesson is None:
            known = suggestion(word, [*TEACH_COMMANDS, "quit"])
            raise NoSuchName(f"there is no command {quoted(word)}; " + (known or "`help` lists the commands"))
        return lesson.act(self.teacher, rest)

    def _quit(self) -> Answer:
        unsaved = self.teacher.unsaved
        self.over = self.warned or not unsaved
        self.warned = True
        if self.over:
            return answer(self.teacher.workplace)
        raise Refused(
            f"not saved: {', '.join(unsaved)}; `save` saves them, and a second `quit` leaves without saving"
        )


# -- moving ---------------------------------------------------------------------------------------------


def _joint(teacher: Teacher, words: list[str]) -> Answer:
    number, amount = _exactly(words, 2, "j3 +1")
    index = int(number) - 1
    joint = teacher.workplace.run.arm.joints[index]
    value = _number(amount) * (INCH if joint.kind == "prismatic" else DEGREE)
    relative = amount[0] in "+-"
    teacher.joint(index, float(teacher.workplace.q[index]) + value if relative else value)
    return _where(teacher, "hand joints")


def _table(teacher: Teacher, words: list[str]) -> Answer:
    return _jogged(teacher, words, np.eye(3), "table x +.5` or `table turn z 10")


def _hand(teacher: Teacher, words: list[str]) -> Answer:
    R_WT = teacher.workplace.run.drive.hand()[:3, :3]
    return _jogged(teacher, words, R_WT, "hand z -.2` or `hand turn y 5")


def _jogged(teacher: Teacher, words: list[str], R: Array, example: str) -> Answer:
    """Move the hand along an axis of the frame with rotation `R`, or turn it about that axis."""
    turns = bool(words) and words[0].lower() == "turn"
    axis, amount = _exactly(words[1:] if turns else words, 2, example)
    x, y, z = R @ _along(axis, _number(amount) * (DEGREE if turns else INCH))
    (teacher.turn if turns else teacher.straight)((float(x), float(y), float(z)))
    return _where(teacher)


def _function(word: str) -> Callable[[Teacher, list[str]], Answer]:
    return lambda teacher, words: teacher.function(" ".join([word, *words]))


def _float(teacher: Teacher, words: list[str]) -> Answer:
    _exactly(words, 0, "float")
    teacher.let_go()
    return _where(teacher)


def _push(teacher: Teacher, words: list[str]) -> Answer:
    axis, force, seconds = _exactly(words, 3, "push x 5 2")
    if not 0 < _number(seconds) <= MAX_PUSH_S:
        raise BadArgument(f"a push can last at most {MAX_PUSH_S:g} s, not {quoted(seconds)}")
    if abs(_number(force)) > 200:
        raise BadArgument(f"a push can be at most 200 oz, not {quoted(force)}")
    teacher.push(_along(axis, _number(force) * OUNCE_FORCE), _number(seconds))
    told = _where(teacher).said.show
    return answer(
        teacher.workplace,
        show=told,
        said="the arm was pushed from outside; no program can contain this motion",
    )


# -- naming ---------------------------------------------------------------------------------------------


def _here(teacher: Teacher, words: list[str]) -> Answer:
    again = bool(words) and words[-1].lower() == "again"
    words = words[:-1] if again else words
    if len(words) not in (1, 3) or (len(words) == 3 and words[1].lower() != "of"):
        raise BadArgument("name a position with `here NAME`, `here NAME of PART` or `here NAME again`")
    name, part = words[0], words[2] if len(words) == 3 else None
    if not NAME.fullmatch(name):
        raise BadArgument(
            f"{quoted(name)} is not a name: a name consists of letters, digits and _, and does not start with a digit"
        )
    if again and part is None and name in teacher.workplace.taught.positions:
        part = teacher.workplace.taught.positions[name].of
    return answer(teacher.workplace, said=f"{name} is {_written(teacher.name(name, part, again=again))}")


def _written(position: Position) -> str:
    lengths = [f"{round(value / INCH, 3) + 0.0:g}" for value in position.at[:3]]
    angles = [f"{round(value / DEGREE, 2) + 0.0:g}" for value in position.at[3:]]
    of = "" if position.of is None else f" of {position.of}"
    return f"[{' '.join(lengths + angles)}]{of}"


def _list(teacher: Teacher, words: list[str]) -> Answer:
    _exactly(words, 0, "list")
    known, unsaved = teacher.workplace.taught.positions, teacher.unsaved
    width = max(map(len, known), default=0)
    lines = [f"{n:{width}}  {_written(p)}{', not saved' if n in unsaved else ''}" for n, p in known.items()]
    return answer(teacher.workplace, lines=tuple(lines or ["no positions are taught"]))


def _save(teacher: Teacher, words: list[str]) -> Answer:
    _exactly(words, 0, "save")
    names = teacher.save()
    if not names:
        return answer(teacher.workplace, said="there is nothing new to save")
    said = f"{', '.join(names)} written to {teacher.file}"
    return answer(teacher.workplace, said=said, file=str(teacher.file))


def _undo(teacher: Teacher, words: list[str]) -> Answer:
    _exactly(words, 0, "undo")
    return answer(teacher.workplace, said=teacher.undo())


def _look(teacher: Teacher, words: list[str]) -> Answer:
    _exactly(words, 0, "where")
    return _where(teacher, "joints hand gap")


def _where(teacher: Teacher, what: str = "hand") -> Answer:
    return answer(teacher.workplace, show=show(teacher.workplace.runner, what))


def _help(teacher: Teacher, _: list[str]) -> Answer:
    tail = "Lengths are in inches, angles in degrees, forces in ounces. `quit` leaves."
    return answer(teacher.workplace, lines=(*rows(TABLE), tail))


# -- reading --------------------------------------------------------------------------------------------


def _exactly(words: list[str], count: int, example: str) -> list[str]:
    if len(words) != count:
        raise BadArgument(f"write the command as in `{example}`")
    return words


def _number(word: str) -> float:
    if not re.fullmatch(r"[+-]?(\d{1,4}\.?\d{0,6}|\.\d{1,6})", word, re.ASCII):
        raise BadArgument(f"{quoted(word)} is not a number")
    return float(word)


def _along(axis: str, size: float) -> Vector3:
    if axis.lower() not in AXES:
        raise BadArgument(f"{quoted(axis)} is not an axis; the axes are x, y and z")
    x, y, z = (size if axis.lower() == name else 0.0 for name in AXES)
    return x, y, z


_TABLE_HELP: Final = (
    "move the hand along an axis of the table, or turn the hand about an axis: `table turn z 10`"
)
_HAND_HELP: Final = (
    "move the hand along one of its own axes (z is its pointing direction), or turn the hand about "
    "an axis: `hand turn y 5`"
)
TABLE: Final[tuple[Command[Callable[[Teacher, list[str]], Answer]], ...]] = (
    Command(
        usage="j3 +1",
        act=_joint,
        help="move a joint by an amount; `j3 20`, without a sign, moves it to a position",
    ),
    Command(usage="table x +.5", act=_table, help=_TABLE_HELP),
    Command(usage="hand z -.2", act=_hand, help=_HAND_HELP),
    Command(usage="move NAME", act=_function("MOVE"), help="go to a position"),
    Command(usage="open GAP", act=_function("OPEN"), help="open the hand"),
    Command(usage="close [MIN]", act=_function("CLOSE"), help="close the hand"),
    Command(usage="center [MIN]", act=_function("CENTER"), help="close the hand without pushing the part"),
    Command(usage="float", act=_float, help="release the brakes; the arm then follows a push"),
    Command(usage="push x 5 2", act=_push, help="push the arm, here along x with 5 oz for 2 s"),
    Command(
        usage="here NAME [of PART]",
        act=_here,
        help="give the present position a name; `here NAME again` replaces an earlier position of this name",
    ),
    Command(usage="where", act=_look, help="show where the arm is"),
    Command(usage="list", act=_list, help="list what is taught"),
    Command(
        usage="undo", act=_undo, help="undo the last motion, or the naming of a position if that came later"
    ),
    Command(usage="save", act=_save, help="write the new names to the file; the rest of the file is kept"),
    Command(usage="help", act=_help, help="show this"),
)
TEACH_COMMANDS: Final = {lesson.name: lesson for lesson in TABLE[1:]}
