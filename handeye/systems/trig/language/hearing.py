"""Carries out typed lines as commands, or refuses them in a sentence."""

from typing import Final

from handeye.core.diagnostics import nearest, quoted
from handeye.core.errors import BadArgument, NoSuchName
from handeye.systems.trig.language.command_table import COMMANDS, SYNONYMS, TABLE, TrigCommand
from handeye.systems.trig.language.desk import ENDS, Cancelled
from handeye.systems.trig.language.given import read_given
from handeye.systems.trig.language.place import AXES
from handeye.systems.trig.language.session import Session
from handeye.systems.trig.language.tabletop import MARK, arrange

WITHDRAWN: Final = "cancelled"
TABLE_HELP: Final = (
    "To lay the table, as somebody beside it:",
    "  * STACK 20 X 150 Y 0  put blocks on each other at a place, in mm",
    "  * BUCKET X 140 Y 0    put a bucket there",
    "  * CLEAR               take everything away",
)


def hear(session: Session, line: str) -> None:
    """Carry out a line; a wrong or cancelled one leaves the program unchanged."""
    word, _, rest = stripped(line).partition(" ")
    if not word:
        return
    if word.startswith(MARK):
        session.desk.tell(arrange(session.table, f"{word} {rest}"))
        return
    if word.upper() in ("HELP", "?"):
        session.desk.tell(help(rest.strip()))
        return
    command = command_of(word)
    try:
        command.act(session, read_given(command.usage, command.takes, command.needs, rest.strip()))
    except Cancelled:
        session.desk.tell(WITHDRAWN)
    session.desk.refresh()


def stripped(line: str) -> str:
    """The command part of a line, without the paper's prompt and remarks."""
    return " ".join(line.partition(";")[0].split()).removeprefix(">").lstrip()


def command_of(word: str) -> TrigCommand:
    """The command of a word, in any case; raises NoSuchName."""
    upper = word.upper()
    command = COMMANDS.get(SYNONYMS.get(upper, upper))
    if command is not None:
        return command
    if upper in (*AXES, *ENDS):
        raise BadArgument(f"{upper} is on the teach box, which is heard while M or FREE waits for it")
    near = nearest(upper, [*COMMANDS, *SYNONYMS], max(1, len(upper) // 3)) if len(upper) > 1 else None
    raise NoSuchName(
        f"there is no command {quoted(word)}; " + (f"did you mean {near}?" if near else "HELP lists them")
    )


def help(word: str) -> str:
    """Help on all commands, or on one."""
    if word:
        command = command_of(word)
        return f"{command.usage}: {command.help}"
    lines: list[str] = []
    width = max(len(command.usage) for command in TABLE)
    for group in dict.fromkeys(command.group for command in TABLE):
        rows = [f"  {each.usage:{width}}  {each.help}" for each in TABLE if each.group == group]
        lines += [*([""] if lines else []), f"To {group}:", *rows]
    return "\n".join([*lines, "", *TABLE_HELP])
