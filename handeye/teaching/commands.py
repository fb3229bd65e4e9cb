"""Commands of the arm program besides functions, as a table from which reading and help derive."""

import re
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Final

from msgspec import UNSET

from handeye.al.includes import read_script
from handeye.al.instructions import EXPLAINED, INSTRUCTIONS
from handeye.al.parser import parse
from handeye.core.diagnostics import quoted, suggestion
from handeye.core.errors import BadArgument, CannotWrite, HandeyeError, NoSuchName, Refused
from handeye.core.files import beside, write_whole
from handeye.debugger.command import Command, check_bare, rows
from handeye.debugger.views import show
from handeye.program.events import Choice
from handeye.teaching.answers import Answer, LineResult
from handeye.teaching.functions import lasting
from handeye.teaching.plan_and_run import answer
from handeye.teaching.repl import Repl


@dataclass(frozen=True, slots=True)
class ReplSession:
    """Understands lines: commands, and functions to be collected."""

    repl: Repl

    @property
    def over(self) -> bool:
        """Somebody has left."""
        return self.repl.over

    def hear(self, line: str) -> Answer:
        """Carry out a command, or collect a function."""
        try:
            given = self._given(line)
        except HandeyeError as error:
            given = answer(self.repl.workplace, LineResult(error=str(error)))
        return replace(given, typed=line.strip())

    def _given(self, line: str) -> Answer:
        word, rest = [*line.split(maxsplit=1), "", ""][:2]
        command = COMMANDS.get(word.upper())
        if command is None:
            return self.repl.collect(line)
        check_bare([command], rest)
        return command.act(self.repl, rest.strip())


def _do(repl: Repl, rest: str) -> Answer:
    """Carry out what is collected, or a function, macro or program now."""
    if not rest:
        if not any(map(str.strip, repl.functions)):
            raise Refused("nothing is collected; type functions, or `DO OPEN 3` to carry one out at once")
        return repl.carry_out(repl.typed("\n".join(repl.functions)))
    definitions = lasting(repl.functions)
    name = rest.split(";")[0].strip()
    text = "\n".join([rest, "", *definitions])
    macros = parse("\n".join(definitions))[0].macros
    if not re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII) or name.upper() in (*INSTRUCTIONS, *macros):
        return repl.carry_out(repl.typed(text), alone=True)
    file = repl.folder / f"{name}.al"
    if not file.is_file():
        known = suggestion(name, [*INSTRUCTIONS, *macros, *_programs(repl.folder)])
        help = f"; {known}" if known is not None else ""
        raise BadArgument(f"there is no instruction, macro or program {quoted(name)}{help}")
    return repl.carry_out(read_script(file))


def _programs(folder: Path) -> list[str]:
    return sorted(file.stem for file in folder.glob("*.al"))


def _list(repl: Repl, _: str) -> Answer:
    lines = tuple(f"{number:3}  {line}" for number, line in enumerate(repl.functions, 1))
    return answer(repl.workplace, LineResult(lines=lines, said=UNSET if lines else "nothing is collected"))


def _drop(repl: Repl, _: str) -> Answer:
    if not repl.functions:
        raise Refused("nothing is collected")
    return answer(repl.workplace, LineResult(said=f"dropped: {repl.functions.pop().strip()}"))


def _clear(repl: Repl, _: str) -> Answer:
    repl.functions.clear()
    return answer(repl.workplace, LineResult(said="nothing is collected"))


def _write(repl: Repl, rest: str) -> Answer:
    if not rest:
        raise BadArgument("`WRITE` takes the name of a file")
    path = beside(Path(rest), ".al")
    if path.exists():
        raise CannotWrite(f"{path} already exists; nothing was written")
    write_whole(path, ("\n".join(repl.functions) + "\n").encode())
    return answer(repl.workplace, LineResult(file=str(path), said=f"written to {path}"))


def _show(repl: Repl, rest: str) -> Answer:
    return answer(repl.workplace, LineResult(show=show(repl.workplace.runner, rest)))


def _back(repl: Repl, _: str) -> Answer:
    repl.workplace.back()
    return answer(repl.workplace, LineResult(said="the last `DO` is undone"))


def _answer(choice: Choice) -> Callable[[Repl, str], Answer]:
    return lambda repl, _: repl.go_on(choice)


def _quit(repl: Repl, _: str) -> Answer:
    repl.over = True
    return answer(repl.workplace)


def _help(repl: Repl, rest: str) -> Answer:
    if rest:
        definition = EXPLAINED.get(rest.upper())
        if definition is None:
            known = suggestion(rest, EXPLAINED)
            raise NoSuchName(f"there is no instruction {quoted(rest)}" + (f"; {known}" if known else ""))
        return answer(repl.workplace, LineResult(said=f"{definition.usage}: {definition.help}"))
    lines = (
        "A line is a function of the arm language, which is collected, or one of",
        *rows(_TABLE),
        "What is collected stays until CLEAR. `HELP MOVE` explains an instruction.",
    )
    return answer(repl.workplace, LineResult(lines=lines))


_TABLE: Final[tuple[Command[Callable[[Repl, str], Answer]], ...]] = (
    Command(usage="DO", act=_do, help="carry out what is collected"),
    Command(usage="DO FUNCTION", act=_do, help="plan one function and carry it out now: DO OPEN 3"),
    Command(usage="DO NAME", act=_do, help="carry out a macro, or the program in the file NAME.al"),
    Command(usage="LIST", act=_list, help="list what is collected"),
    Command(usage="DROP", act=_drop, help="drop the last line collected"),
    Command(usage="CLEAR", act=_clear, help="drop all of them"),
    Command(usage="WRITE FILE", act=_write, help="write them to a new file, as a script"),
    Command(usage="SHOW [WHAT]", act=_show, help="show joints, hand, gap, saved differences, positions, ..."),
    Command(usage="BACK", act=_back, help="undo the last DO: restores arm, parts and memory"),
    Command(usage="PROCEED", act=_answer("proceed"), help="continue after what called the operator"),
    Command(usage="RETRY", act=_answer("retry"), help="repeat from the first function of the stage"),
    Command(usage="SKIP", act=_answer("skip"), help="skip the rest of the stage"),
    Command(usage="HELP [INSTRUCTION]", act=_help, help="show this, or what an instruction does"),
    Command(usage="QUIT", act=_quit, help="leave"),
    Command(usage="EXIT", act=_quit, help="leave, too"),
)
COMMANDS: Final = {command.name: command for command in _TABLE}
"""By their words."""
