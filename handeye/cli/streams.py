"""The standard streams as we find them: closed, in an encoding without our marks, with nobody at the other end."""

import codecs
import io
import os
import sys
from typing import Final

STAND_INS: Final = {
    "✓": "+", "✗": "x", "▸": ">", "→": ">", "↶": "<", "■": "#", "·": ".", "•": "*", "°": "d", "−": "-", "–": "-",
    "—": "-", "─": "-", "│": "|", "┌": "+", "├": "+", "…": "...", "“": '"', "”": '"', "„": '"', "«": '"', "»": '"',
    "‘": "'", "’": "'",
}  # fmt: skip
"""What an encoding without these gets instead: as wide as they are, but for the last of a line that was cut."""
_PLAIN: Final = "handeye.plain"


def prepare_streams() -> None:
    """Make the standard streams such that no character raises: one that the encoding lacks has a stand-in, or `?`.

    The null device is in the place of a stream that was closed before we came.
    """
    codecs.register_error(_PLAIN, _stand_in)
    for name, mode, errors in (("stdin", "r", "replace"), ("stdout", "w", _PLAIN), ("stderr", "w", _PLAIN)):
        if getattr(sys, name) is None:
            setattr(sys, name, open(os.devnull, mode, encoding="utf-8"))  # noqa: SIM115 - it is open for good
        stream = getattr(sys, name)
        if isinstance(stream, io.TextIOWrapper):
            stream.reconfigure(errors=errors)


def let_go_of_streams() -> None:
    """Drop what cannot be written any more, so that the interpreter does not try again when it ends."""
    for stream in (sys.stdout, sys.stderr):
        if stream.closed:
            continue
        try:
            stream.flush()
        except OSError:
            os.dup2(os.open(os.devnull, os.O_WRONLY), stream.fileno())


def _stand_in(error: UnicodeError) -> tuple[str, int]:
    """What stands in the place of characters that an encoding lacks, and where the text goes on."""
    if not isinstance(error, UnicodeEncodeError):
        raise error
    lacking = error.object[error.start : error.end]
    return "".join(STAND_INS.get(character, "?") for character in lacking), error.end
