"""Documents for the tests of what editors ask; `|` marks the pointer."""

from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source
from handeye.editor.document import Document
from handeye.editor.navigation import Edit
from handeye.editor.samples import SAMPLE

TAUGHT = """\
[parts.BASE] # on the belt
at = [25.0, 38.0, 0.0, 0.0]

[parts]
GASKET = { at = [26, 48, 0, 0] }

[positions]
PARK = { at = [20, 28, 8, 90, 90, 0] }
P = { at = [18, 44, 3, 90, 90, 0], of = "BASE" }

[positions.T]
at = [25, 38, 4, 90, 90, 0]
of = "BASE"
"""


def document(text: str, taught_text: str = "") -> Document:
    return Document(source=Source(name="test.al", text=text), taught=SAMPLE, taught_text=taught_text)


def pointed(marked: str, taught_text: str = "") -> tuple[Document, int]:
    """The document, and the offset of the pointer in it."""
    assert marked.count("|") == 1
    return document(marked.replace("|", ""), taught_text), marked.index("|")


def diagnosed(text: str) -> list[Diagnostic]:
    return document(text).compiled[1]


def edited(text: str, edits: "tuple[Edit, ...] | list[Edit]", *, taught: bool = False) -> str:
    """The text after edits, all of which speak of the text before."""
    for edit in sorted((e for e in edits if e.taught == taught), key=lambda e: e.span, reverse=True):
        text = text[: edit.span.start] + edit.text + text[edit.span.end :]
    return text
