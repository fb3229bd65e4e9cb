"""The command line: parses arguments, calls the other packages, and prints results."""

import codecs
import gc
import io
import os
import sys
from contextlib import suppress
from typing import Final, NoReturn

from cyclopts import App, CycloptsError, Parameter

from handeye.cli import completion
from handeye.cli.commands import COMMANDS, add_commands
from handeye.cli.common import complain, note, notes, screen
from handeye.core.entries import entries
from handeye.core.errors import HandeyeError
from handeye.core.signals import break_in, heard
from handeye.core.versions import HANDEYE

BAD_INPUT: Final = 2
INTERRUPTED: Final = 130
GONE: Final = 141
_NO_MEMORY: Final = "allocate memory"

app = App(
    name="handeye",
    version=HANDEYE,
    help="Simulates a robot arm that assembles a water pump by camera, touch and force, as an arm at Stanford "
    "did in 1973.\n\n"
    "Try `handeye demo` first. `handeye COMMAND --help` shows the options of a command; `handeye docs` lists the "
    "pages of the documentation.",
    suppress_keyboard_interrupt=False,
    default_parameter=Parameter(negative=""),
    console=screen,
    error_console=notes,
)
add_commands(app, COMMANDS, __package__)
for entry in entries().values():
    with suppress(KeyError, ValueError):  # a malformed table in another package must not break any command
        add_commands(app, entry.commands)
completion.register(app)


def main() -> NoReturn:
    """Run the command line and return its exit code."""
    prepare_streams()
    try:
        code = _carried_out()
        if not sys.stdout.closed:  # as the language server does when its client says goodbye
            sys.stdout.flush()  # here, where a full disk can still be reported
    except BrokenPipeError:  # the program that read our output has ended, which is not an error of ours
        code = GONE
    except OSError as error:
        code = _complained(f"standard output: {error.strerror}")
    let_go_of_streams()
    gc.freeze()  # the process ends: a search for garbage would only take time
    sys.exit(code)


def _carried_out() -> int:
    """Execute the typed command, and return its exit code. Raises OSError if the output cannot be written."""
    try:
        with heard(break_in):
            code = app(result_action="return_value", exit_on_error=False, print_error=False)
    except CycloptsError as error:
        from handeye.cli.usage import usage_sentence

        return _complained(usage_sentence(error))
    except HandeyeError as error:
        return _complained(error)
    except KeyboardInterrupt:
        note("\nhandeye: interrupted")
        return INTERRUPTED
    except UnicodeEncodeError as error:  # byte 0xff of a name is read as U+DCFF, which cannot be encoded
        byte = ord(error.object[error.start]) & 0xFF
        return _complained(
            f"the name contains the byte {byte:#04x}, which is not UTF-8 text; choose another name"
        )
    except OSError as error:  # a path that is too long, or a folder that may not be read
        if error.filename is None:
            raise
        return _complained(f"{error.filename}: {error.strerror}")
    except Exception as error:  # MuJoCo raises a ValueError
        if not (isinstance(error, MemoryError) or _NO_MEMORY in str(error)):
            raise
        return _complained("out of memory; close other programs, or raise the limit (`ulimit -v`)")
    return code if isinstance(code, int) else 0


def _complained(sentence: object) -> int:
    """Print an error if standard error is still open, and return the exit code for bad input."""
    with suppress(OSError):
        complain(sentence)
    return BAD_INPUT


STAND_INS: Final = {
    "✓": "+", "✗": "x", "▸": ">", "→": ">", "↶": "<", "■": "#", "·": ".", "•": "*", "°": "d", "−": "-", "–": "-",
    "—": "-", "─": "-", "│": "|", "┌": "+", "├": "+", "…": "...", "“": '"', "”": '"', "„": '"', "«": '"', "»": '"',
    "‘": "'", "’": "'",
}  # fmt: skip
"""Replacements for characters that an encoding lacks. Each replacement has the width of the character it replaces,
except the three full stops that replace an ellipsis.
"""
_PLAIN: Final = "handeye.plain"


def prepare_streams() -> None:
    """Make the standard streams accept every character. A character that the encoding lacks is replaced by a
    similar character or by `?`. A stream that was already closed when Python started is replaced by the null
    device.
    """
    codecs.register_error(_PLAIN, _stand_in)
    for name, mode, errors in (("stdin", "r", "replace"), ("stdout", "w", _PLAIN), ("stderr", "w", _PLAIN)):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))  # noqa: SIM115 - stays open for the life of the process
        stream = getattr(sys, name)
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=errors)


def let_go_of_streams() -> None:
    """Drop output that can no longer be written, so that the interpreter does not try to write it again when the
    interpreter exits.
    """
    for stream in (sys.stdout, sys.stderr):
        if stream.closed:
            continue
        try:
            stream.flush()
        except OSError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _stand_in(error: UnicodeError) -> tuple[str, int]:
    """The replacement for characters that an encoding lacks, and the position at which encoding continues."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    lacking = error.object[error.start : error.end]
    return "".join(STAND_INS.get(character, "?") for character in lacking), error.end
