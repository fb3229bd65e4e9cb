"""Checks the form of a text itself, whatever it requires."""

from handeye.al.parser import parse_whole
from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source

# Part of the text is missing, so that its definitions would be reported as unknown.
MISSING = ("unreadable-file", "too-much-required")
_OF_OTHERS = (*MISSING, "require-circle", "required-twice")


def check_form(source: Source) -> list[Diagnostic]:
    """Syntax errors of a text alone; required texts are read for macro names."""
    found = parse_whole(source)[1]
    left_out = {*_OF_OTHERS}
    if any(d.code in MISSING for d in found):
        left_out.add("unknown-instruction")
    return [d for d in found if d.code not in left_out and not source.find(d.primary.span.start)[0].key]
