"""Cures: for a diagnostic whose cure is known, the edits that bring it about.

Most are told by the diagnostic itself, in its help and its labels; so new diagnostics in the same words get theirs.
"""

import re
from collections.abc import Callable, Iterator
from typing import Final

from handeye.diagnostics import Diagnostic, quoted
from handeye.editor import fix_lines, fix_operands
from handeye.editor.document import Document
from handeye.editor.fix import Fix, replace

_DID_YOU_MEAN: Final = re.compile(r"did you mean `(.+?)`\?")
_KNOWN: Final = re.compile(r"known: (`.+`)$")
_UNUSED: Final = "unused-"


def fixes(document: Document, diagnostic: Diagnostic) -> list[Fix]:
    """The cures of a diagnostic of the document; none if none is known."""
    if any(label.span.end > len(document.text) for label in (diagnostic.primary, *diagnostic.secondary)):
        return []  # some of it stands in a required file
    cure = _CURES.get(diagnostic.code)
    if cure is None and diagnostic.code.startswith(_UNUSED):
        cure = fix_lines.remove_unused
    found = [*_suggested(diagnostic), *(cure(document, diagnostic) if cure is not None else ())]
    return list(dict.fromkeys(found))


def _suggested(diagnostic: Diagnostic) -> Iterator[Fix]:
    help, span = diagnostic.help or "", diagnostic.primary.span
    for name in _DID_YOU_MEAN.findall(help):
        yield replace(span, name, f"change to {quoted(name)}")
    if known := _KNOWN.search(help):
        for name in re.findall(r"`(.+?)`", known[1]):
            yield replace(span, name, f"change to {quoted(name)}", choice=True)


_CURES: Final[dict[str, Callable[[Document, Diagnostic], Iterator[Fix]]]] = {
    "aoj-without-search": fix_lines.begin_search,
    "compared-without-hold": fix_operands.hold,
    "error-never-raised": fix_lines.drop_test,
    "label-splits-modifier": fix_lines.label_first,
    "macro-ends-early": fix_lines.close_up,
    "missing-operand": fix_operands.fill_in,
    "modifier-misplaced": fix_lines.remove_line,
    "modifier-twice": fix_lines.remove_line,
    "modifier-without-motion": fix_lines.remove_line,
    "never-saved": fix_lines.remove_line,
    "number-out-of-range": fix_operands.nearest_number,
    "required-twice": fix_lines.remove_line,
    "restore-without-move": fix_lines.remove_line,
    "search-without-aoj": fix_lines.remove_line,
    "skip-at-end": fix_lines.remove_line,
    "skip-over-modifier": fix_lines.jump_over,
    "test-without-action": fix_lines.drop_test,
    "too-many-operands": fix_operands.drop_operands,
    "typed-word": fix_operands.instruction_alone,
    "unexpected-character": fix_operands.drop_mark,
    "unknown-instruction": fix_operands.colon,
    "unknown-lens": fix_operands.nearest_number,
    "unreachable-code": fix_lines.remove_line,
    "unterminated-macro": fix_operands.end_macro,
    "unterminated-string": fix_operands.close_string,
    "unterminated-vector": fix_operands.close_vector,
    "wrong-operand": fix_operands.quote,
}
"""Fixes of a diagnostic, beside the suggestion of its help."""
