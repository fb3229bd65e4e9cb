"""Check the form of a text itself, whatever its names mean and whatever it requires."""

from handeye.al.parser import parse_whole
from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source

MISSING = ("unreadable-file", "too-much-required")
"""A part of the text is not there: what it makes would be told as unknown."""
_OF_OTHERS = (*MISSING, "require-circle", "required-twice")


def check_form(source: Source) -> list[Diagnostic]:
    """The mistakes of a text alone; what it requires is looked at for the names of macros."""
    found = parse_whole(source)[1]
    left_out = {*_OF_OTHERS}
    if any(d.code in MISSING for d in found):
        left_out.add("unknown-instruction")
    return [d for d in found if d.code not in left_out and not source.find(d.primary.span.start)[0].key]
