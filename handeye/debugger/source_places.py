"""Places in a script that may be sewn of several files, as users name them."""

import re
from pathlib import Path
from typing import Final

from handeye.core.diagnostics import quoted
from handeye.core.errors import NoSuchName
from handeye.runs.system import Listing

Place = tuple[str, int]
"""A required file, or the script itself if that is empty, and a line of it."""
_PLACE: Final = re.compile(r"(?:(?P<file>[^:]+):)?(?P<line>[0-9]{1,9})")


def text_of(program: Listing, file: str) -> str:
    """The text of a required file, or of the script itself."""
    return program.required[file] if file else program.source


def named_place(text: str, program: Listing) -> Place | None:
    """The place a user means by `12`, `pins.al:12` or `lib/pins.al:12`; None if that is not the form of one.

    Raises:
        InvalidInput: the script is not sewn of such a file.
    """
    given = _PLACE.fullmatch(text.strip())
    if given is None:
        return None
    file, line = given["file"] or "", int(given["line"])
    if not file or (file not in program.required and file in (program.name, f"{program.name}.al")):
        return "", line
    found = [key for key in program.required if key == file or key.endswith(f"/{file}")]
    if not found and Path(file).name == f"{program.name}.al":
        return "", line
    if not found:
        known = ", ".join(map(quoted, program.required)) or "none"
        raise NoSuchName(f"the script requires no file {quoted(file)}; it requires: {known}")
    return (file if file in found else found[0]), line
