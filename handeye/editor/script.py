"""A script in a client's workspace, with what is taught beside it."""

from collections.abc import Iterable
from pathlib import Path

from lsprotocol import types as lsp
from pygls.uris import from_fs_path, to_fs_path
from pygls.workspace import Workspace

from handeye.al.parser import parse
from handeye.diagnostics import Diagnostic, arranged
from handeye.editor import wire
from handeye.editor.document import Document
from handeye.editor.navigation import Edit, Found
from handeye.errors import InvalidInput
from handeye.plan.taught import Taught, load_taught
from handeye.source import Source, Span, read_source


class Script:
    """A document, and how its client counts."""

    def __init__(self, workspace: Workspace, uri: str) -> None:
        text = workspace.get_text_document(uri)
        self.uri, self.version = uri, text.version
        self.units: wire.Units = text.position_codec.client_num_units
        self.problem: str | None = None
        path = to_fs_path(uri) if uri.startswith("file:") else None
        beside = Path(path).with_suffix(".toml") if path else None
        taught, taught_text, self.taught_uri = Taught(), "", ""
        if beside is not None and beside.is_file():
            self.taught_uri = from_fs_path(str(beside)) or ""
            opened = workspace.text_documents.get(self.taught_uri)
            try:
                taught_text = read_source(beside).text if opened is None else opened.source
                taught = load_taught(beside)
            except InvalidInput as error:
                self.problem = str(error)
        source = Source(name=Path(path).name if path else uri, text=text.source)
        self.document = Document(source=source, taught=taught, taught_text=taught_text)

    def diagnostics(self) -> list[Diagnostic]:
        """What the text tells; its form alone, if what is taught cannot be used."""
        if self.problem is not None:
            return arranged(parse(self.document.text)[1])
        return self.document.compiled[1]

    def offset(self, position: lsp.Position) -> int:
        """The offset of a position."""
        return wire.offset(self.document.source, position, self.units)

    def range(self, span: Span) -> lsp.Range:
        """The range of a span of the script."""
        return wire.range_(self.document.source, span, self.units)

    def location(self, found: Found) -> lsp.Location:
        """Where a place is, in whichever of the two files."""
        if found.taught:
            return lsp.Location(uri=self.taught_uri, range=wire.range_(self._taught, found.span, self.units))
        return lsp.Location(uri=self.uri, range=self.range(found.span))

    def edit(self, edits: Iterable[Edit]) -> lsp.WorkspaceEdit:
        """Edits of both files."""
        changes: dict[str, list[lsp.TextEdit]] = {}
        for edit in edits:
            place = self.location(Found(span=edit.span, taught=edit.taught))
            changes.setdefault(place.uri, []).append(lsp.TextEdit(range=place.range, new_text=edit.text))
        return lsp.WorkspaceEdit(changes=changes)

    @property
    def _taught(self) -> Source:
        """The file beside the script."""
        return Source(name="", text=self.document.taught_text)
