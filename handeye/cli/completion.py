"""The command that installs completion for a shell."""

import os
from pathlib import Path
from typing import Annotated, Final, Literal

from cyclopts import App, Parameter

from handeye.cli.commands import restore_docstring
from handeye.cli.common import say
from handeye.core.errors import BadArgument

Shell = Literal["bash", "zsh", "fish"]

SHELLS: Final[dict[str, Shell]] = {"bash": "bash", "zsh": "zsh", "fish": "fish"}
START_UP: Final[dict[Shell, str]] = {"bash": ".bashrc", "zsh": ".zshrc"}
"""For each shell, the file in the home folder that loads completions when the shell starts; fish needs no such file."""
CONDITION: Final[dict[Shell, str]] = {"zsh": ", if its .zshrc calls compinit"}


def register(app: App) -> None:
    """Give the command line a command that installs completion."""

    def install_completion(
        shell: Annotated[
            Shell | None, Parameter(help="The shell. Default: the shell that the variable SHELL names.")
        ] = None,
    ) -> int:
        """Make the Tab key complete commands and options in bash, zsh or fish.

        Writes a file of completions in the home folder, and a line in .bashrc or .zshrc that loads it. Prints what it
        wrote.
        """
        chosen = shell or _shell_of_the_user()
        before = _start_up_text(chosen)
        say(f"{app.install_completion(shell=chosen)}: written")
        if chosen in START_UP:
            changed = _start_up_text(chosen) != before
            say(f"{_start_up(chosen)}: {'now loads this file' if changed else 'already loads this file'}")
        say(f"Completion works in every new {chosen} session{CONDITION.get(chosen, '')}.")
        return 0

    restore_docstring(install_completion)
    app.command(install_completion, name="--install-completion")


def _shell_of_the_user() -> Shell:
    named = Path(os.environ.get("SHELL", "")).name
    if named in SHELLS:
        return SHELLS[named]
    found = f"the variable SHELL names `{named}`" if named else "the variable SHELL names no shell"
    raise BadArgument(f"completion is available for bash, zsh and fish, but {found}: choose one with --shell")


def _start_up(shell: Shell) -> Path:
    return Path.home() / START_UP[shell]


def _start_up_text(shell: Shell) -> bytes | None:
    return _start_up(shell).read_bytes() if shell in START_UP and _start_up(shell).exists() else None
