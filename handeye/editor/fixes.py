"""Finds fixes for diagnostics. The field `meant` of a diagnostic may give replacements for a name. A table gives
further fixes for each code.
"""

from collections.abc import Callable, Iterator
from typing import Final

from handeye.core.diagnostics import Diagnostic, KnownNames, SimilarName, quoted
from handeye.editor import fix_lines, fix_operands
from handeye.editor.document import Document
from handeye.editor.fix import Fix, replace


def fixes(document: Document, diagnostic: Diagnostic) -> list[Fix]:
    """Return the fixes for a diagnostic of the document. The list is empty if there are none."""
    if any(label.span.end > len(document.text) for label in (diagnostic.primary, *diagnostic.secondary)):
        return []  # part of the diagnostic is in a required file
    cure = _CURES.get(diagnostic.code)
    found = [*_meant(diagnostic), *(cure(document, diagnostic) if cure is not None else ())]
    return list(dict.fromkeys(found))


def _meant(diagnostic: Diagnostic) -> Iterator[Fix]:
    """Yield fixes that replace a name by a similar one."""
    span = diagnostic.primary.span
    match diagnostic.meant:
        case SimilarName(name):
            yield replace(span, name, f"change to {quoted(name)}")
        case KnownNames(names):
            for name in names:
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
    "unused-label": fix_lines.remove_unused,
    "unused-macro": fix_lines.remove_unused,
    "unused-parameter": fix_operands.remove_parameter,
    "unused-position": fix_lines.remove_unused,
    "unused-vector": fix_lines.remove_unused,
    "wrong-operand": fix_operands.quote,
}
