"""Defines the commands of a prompt, and shows the table of commands as help."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument

Act = TypeVar("Act", bound=Callable[..., Any])


@dataclass(frozen=True, slots=True, kw_only=True)
class Command(Generic[Act]):
    """A command of a prompt, with the function that executes it."""

    usage: str
    act: Act
    help: str
    group: str = ""  # its heading in help
    short: str = ""  # its abbreviation
    repeats: bool = False  # an empty line repeats it
    meanwhile: bool = False  # also allowed while the run moves

    @property
    def name(self) -> str:
        return self.usage.partition(" ")[0]

    @property
    def bare(self) -> bool:
        return " " not in self.usage

    @property
    def shown(self) -> str:
        return f"{self.usage}, {self.short}" if self.short else self.usage


def check_bare(named: Iterable[Command[Any]], rest: str) -> None:
    """Raise BadArgument if an operand follows a command that takes none. `named` are all commands with the name
    that was typed."""
    commands = list(named)
    if rest and all(command.bare for command in commands):
        raise BadArgument(f"`{commands[0].name}` takes no operand; remove {quoted(rest)}")


def rows(commands: Iterable[Command[Any]]) -> list[str]:
    """Return the commands as lines of help. The commands of a group follow one another."""
    table = list(commands)
    width = max(len(command.shown) for command in table)
    lines: list[str] = []
    for group in dict.fromkeys(command.group for command in table):
        lines += ["", group] if group else []
        lines += [f"  {each.shown:{width}}  {each.help}" for each in table if each.group == group]
    return lines
