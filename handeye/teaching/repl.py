"""The arm program of 1973, which collects typed instructions. `DO` executes them. A table defines the commands of the
arm program.
"""

import re
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final

import msgspec
from msgspec import UNSET

from handeye.al.includes import read_script, sewn
from handeye.al.instructions import EXPLAINED, INSTRUCTIONS
from handeye.al.parser import parse
from handeye.core.diagnostics import has_errors, quoted, suggestion
from handeye.core.errors import BadArgument, HandeyeError, NoSuchName, Refused
from handeye.core.files import beside, check_new, write_whole
from handeye.core.source import Source, read_source
from handeye.debugger.command import Command, check_bare, rows
from handeye.debugger.views import show
from handeye.program.events import Choice
from handeye.teaching.answers import Answer, about, answer, carry_out, done
from handeye.teaching.functions import TYPED, is_open, lasting, mistakes
from handeye.teaching.workplace import Workplace

MAX_LINES: Final = 500  # whenever a line is added, all lines are checked again
_ANSWERS: Final = (
    "PROCEED, RETRY or SKIP continues the stopped program; a new instruction abandons the program"
)


@dataclass(slots=True, kw_only=True)
class Repl:
    """A session of the arm program. It has a cell, and the instructions that were collected so far."""

    workplace: Workplace
    folder: Path  # folder of the programs for `DO NAME`
    called: str = _ANSWERS  # advice when the operator was called
    functions: list[str] = field(default_factory=list)  # the lines collected
    over: bool = False  # the user has left

    def hear(self, line: str) -> Answer:
        """Execute a command, or collect an instruction."""
        try:
            word, rest = [*line.split(maxsplit=1), "", ""][:2]
            command = COMMANDS.get(word.upper())
            if command is None:
                given = self.collect(line)
            else:
                check_bare([command], rest)
                given = command.act(self, rest.strip())
        except HandeyeError as error:
            given = answer(self.workplace, error=str(error))
        return replace(given, typed=line.strip())

    def collect(self, line: str) -> Answer:
        """Collect a line, unless it has a mistake that no later line can correct. Raises Refused if there are
        too many lines.
        """
        if not line.strip() and not is_open(self.functions):
            return answer(self.workplace)
        if len(self.functions) >= MAX_LINES:
            raise Refused(f"at most {MAX_LINES} lines can be collected; for more, write a script")
        lines = [*self.functions, line]
        checked = self.workplace.plan(self.typed("\n".join(lines)))
        found = mistakes(checked, len(lines))
        if not has_errors(found):
            self.functions = lines
        return about(self.workplace, checked, found)

    def typed(self, text: str) -> Source:
        """Return the typed text as a source, with the files that it requires."""
        return sewn(Source(name=TYPED, text=text), lambda key: read_source(self.folder / key).text)

    def carry_out(self, source: Source, *, alone: bool = False) -> Answer:
        """Plan a text and execute it. If the execution stops early, the answer contains advice."""
        return self._advised(carry_out(self.workplace, source, alone=alone))

    def go_on(self, choice: Choice) -> Answer:
        """Answer a call to the operator. Raises InvalidInput if there is no call."""
        happened = len(self.workplace.runner.events)
        said = done(self.workplace, self.workplace.answer(choice), happened)
        return self._advised(Answer(time=self.workplace.time, said=said))

    def _advised(self, given: Answer) -> Answer:
        advice = {
            "operator": self.called,
            "panic": "the simulator is back at the start of the interrupted step",
        }.get(given.stopped or "")
        if advice is None:
            return given
        return replace(given, said=msgspec.structs.replace(given.said, said=advice))


def _do(repl: Repl, rest: str) -> Answer:
    """Execute the instruction, macro or program in `rest`; if `rest` is empty, execute the collected lines."""
    if not rest:
        if not any(map(str.strip, repl.functions)):
            raise Refused(
                "nothing is collected; type instructions, or `DO OPEN 3` to run one instruction immediately"
            )
        return repl.carry_out(repl.typed("\n".join(repl.functions)))
    definitions = lasting(repl.functions)
    name = rest.split(";")[0].strip()
    text = "\n".join([rest, "", *definitions])
    macros = parse("\n".join(definitions))[0].macros
    if not re.fullmatch(r"[A-Za-z_]\w*", name, re.ASCII) or name.upper() in (*INSTRUCTIONS, *macros):
        return repl.carry_out(repl.typed(text), alone=True)
    file = repl.folder / f"{name}.al"
    if not file.is_file():
        programs = sorted(file.stem for file in repl.folder.glob("*.al"))
        known = suggestion(name, [*INSTRUCTIONS, *macros, *programs])
        help = f"; {known}" if known is not None else ""
        raise BadArgument(f"there is no instruction, macro or program {quoted(name)}{help}")
    return repl.carry_out(read_script(file))


def _list(repl: Repl, _: str) -> Answer:
    lines = tuple(f"{number:3}  {line}" for number, line in enumerate(repl.functions, 1))
    return answer(repl.workplace, lines=lines, said=UNSET if lines else "nothing is collected")


def _drop(repl: Repl, _: str) -> Answer:
    if not repl.functions:
        raise Refused("nothing is collected")
    return answer(repl.workplace, said=f"removed: {repl.functions.pop().strip()}")


def _clear(repl: Repl, _: str) -> Answer:
    repl.functions.clear()
    return answer(repl.workplace, said="nothing is collected")


def _write(repl: Repl, rest: str) -> Answer:
    if not rest:
        raise BadArgument("give `WRITE` the name of a new file, such as `WRITE lid.al`")
    path = beside(Path(rest), ".al")
    check_new(path)
    write_whole(path, ("\n".join(repl.functions) + "\n").encode())
    return answer(repl.workplace, file=str(path), said=f"written to {path}")


def _show(repl: Repl, rest: str) -> Answer:
    return answer(repl.workplace, show=show(repl.workplace.runner, rest))


def _back(repl: Repl, _: str) -> Answer:
    repl.workplace.back()
    return answer(repl.workplace, said="the last `DO` is undone")


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
        return answer(repl.workplace, said=f"{definition.usage}: {definition.help}")
    lines = (
        "A line is either an instruction of the arm language, which the REPL collects, or one of these commands:",
        *rows(_TABLE),
        "Collected lines stay until CLEAR. `HELP MOVE` explains an instruction.",
    )
    return answer(repl.workplace, lines=lines)


_TABLE: Final[tuple[Command[Callable[[Repl, str], Answer]], ...]] = (
    Command(usage="DO", act=_do, help="run the collected lines"),
    Command(usage="DO FUNCTION", act=_do, help="plan one instruction and run it now: DO OPEN 3"),
    Command(usage="DO NAME", act=_do, help="run a macro, or the program in the file NAME.al"),
    Command(usage="LIST", act=_list, help="list the collected lines"),
    Command(usage="DROP", act=_drop, help="remove the last collected line"),
    Command(usage="CLEAR", act=_clear, help="remove all collected lines"),
    Command(usage="WRITE FILE", act=_write, help="write the collected lines to a new file, as a script"),
    Command(usage="SHOW [WHAT]", act=_show, help="show joints, hand, gap, saved differences, positions, ..."),
    Command(usage="BACK", act=_back, help="undo the last DO: restore arm, parts and memory"),
    Command(usage="PROCEED", act=_answer("proceed"), help="continue after the call to the operator"),
    Command(usage="RETRY", act=_answer("retry"), help="repeat from the first instruction of the stage"),
    Command(usage="SKIP", act=_answer("skip"), help="skip the rest of the stage"),
    Command(usage="HELP [INSTRUCTION]", act=_help, help="show this list, or what an instruction does"),
    Command(usage="QUIT", act=_quit, help="leave"),
    Command(usage="EXIT", act=_quit, help="leave, too"),
)
COMMANDS: Final = {command.name: command for command in _TABLE}
