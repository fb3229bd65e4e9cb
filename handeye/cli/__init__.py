"""The command line: parses arguments, wires concrete things together, prints."""

import os
import sys
from typing import NoReturn

from cyclopts import App, CycloptsError, Parameter

from handeye.cli import benches, editing, plans, runs, scripts, teaching, traces, trials, worlds
from handeye.cli.common import complain, notes, screen
from handeye.errors import HandeyeError
from handeye.versions import HANDEYE

app = App(
    name="handeye",
    version=HANDEYE,
    help="The Stanford hand-eye pump assembly of 1973: plan, work, judge.\n\n`handeye COMMAND --help` tells more.",
    suppress_keyboard_interrupt=False,
    default_parameter=Parameter(negative=""),
    console=screen,
    error_console=notes,
)
for commands in (runs, teaching, scripts, editing, plans, traces, worlds, trials, benches):
    commands.register(app)


def main() -> NoReturn:
    """Run the command line; the exit code says how it went."""
    _open_streams()
    try:
        code = app(result_action="return_value", exit_on_error=False)
    except CycloptsError:
        sys.exit(2)
    except HandeyeError as error:
        complain(error)
        sys.exit(2)
    except KeyboardInterrupt:
        notes.print("\nhandeye: interrupted", markup=False)
        sys.exit(130)
    except BrokenPipeError:  # the reader of our output has gone, which is not our trouble
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        sys.exit(141)
    except OSError as error:  # a path that is too long, a folder that may not be looked into
        complain(f"{error.filename or 'standard output'}: {error.strerror}")
        sys.exit(2)
    sys.exit(code if isinstance(code, int) else 0)


def _open_streams() -> None:
    """Put the null device where a standard stream was closed before we came."""
    for name, mode in (("stdin", "r"), ("stdout", "w"), ("stderr", "w")):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))  # noqa: SIM115 - it is open for good
