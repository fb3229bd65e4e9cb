"""A script in an editor's workspace, with its taught file and its required files."""

import os
from collections.abc import Iterable
from pathlib import Path

from lsprotocol import types as lsp
from pygls.uris import from_fs_path, to_fs_path
from pygls.workspace import TextDocument, Workspace

from handeye.al.compiler import check_form
from handeye.al.includes import led_by
from handeye.core.diagnostics import Diagnostic, arranged
from handeye.core.errors import BadFile, InvalidInput
from handeye.core.files import is_there
from handeye.core.source import Source, Span, line_name, read_source, with_line_ends
from handeye.editor import wire
from handeye.editor.document import Document
from handeye.editor.navigation import Edit, Place
from handeye.program.taught import Taught
from handeye.runs.scripts import taught


def text_of(workspace: Workspace, uri: str) -> TextDocument:
    """Return the document at a URI, from the editor or from a file. Raises BadFile if neither the editor nor a file has
    the text.
    """
    if uri not in workspace.text_documents:
        if not uri.startswith("file:"):
            raise BadFile(f"{uri} is not open in the editor")
        read_source(to_fs_path(uri) or uri)
    return workspace.get_text_document(uri)


class EditedScript:
    """A script in an editor's workspace, together with the unit in which the editor counts characters."""

    def __init__(self, workspace: Workspace, uri: str) -> None:
        text = text_of(workspace, uri)
        self.uri, self.version, self._workspace = uri, text.version, workspace
        self.units: wire.Units = text.position_codec.client_num_units
        self.problem: str | None = None
        path = self.path = to_fs_path(uri) if uri.startswith("file:") else None
        self._folder = Path(path).parent if path else None
        known, taught_text, self.taught_uri = Taught(), "", ""
        if path:
            try:
                taught_text = self._taught_text(Path(path).with_suffix(".toml"))
                known = taught(Path(path))
            except InvalidInput as error:
                self.problem = str(error)
        source = Source(name=Path(path).name if path else uri, text=with_line_ends(text.source))
        read = self._read if path else None
        self.document = Document(source=source, taught=known, taught_text=taught_text, read=read)

    def diagnostics(self) -> list[Diagnostic]:
        """Return the diagnostics of the text. If the taught file cannot be used, only syntax errors are
        returned."""
        if self.problem is not None:
            return arranged(check_form(self.document.whole))
        return self.document.compiled[1]

    def offset(self, position: lsp.Position) -> int:
        """Return the offset of a position that is given in the form of the language server protocol."""
        return wire.offset(self.document.source, position, self.units)

    def range(self, span: Span) -> lsp.Range:
        """Return a span of the script as a range of the language server protocol."""
        return wire.range_(self.document.source, span, self.units)

    def published(self, found: Diagnostic) -> lsp.Diagnostic:
        """Return a diagnostic for the editor. A diagnostic in a required file is shown at the REQUIRE that leads to
        the file.
        """
        related = [(self.place(label.span), label.text) for label in found.secondary]
        text, start = self.document.whole.find(found.primary.span.start)
        place = self.place(found.primary.span)
        if not text.key:
            return wire.diagnostic(found, place.range, related)
        where = line_name(text.position(start)[0], text.key)
        at = led_by(self.document.whole, text.key) or Span(start=0, end=0)
        return wire.diagnostic(found, self.range(at), [(place, ""), *related], f"{where}: ")

    def place(self, span: Span) -> lsp.Location:
        """Return a span as a location of the language server protocol."""
        text, start = self.document.whole.find(span.start)
        local = Span(start=start, end=start + span.end - span.start)
        return lsp.Location(uri=self._uri(text), range=wire.range_(text, local, self.units))

    def location(self, found: Place) -> lsp.Location:
        """Return a place in the script, the taught file or a required file as a location of the language server
        protocol.
        """
        if found.taught:
            return lsp.Location(uri=self.taught_uri, range=wire.range_(self._taught, found.span, self.units))
        text = next(text for text in self.document.whole.texts if text.key == found.file)
        return lsp.Location(uri=self._uri(text), range=wire.range_(text, found.span, self.units))

    def edit(self, edits: Iterable[Edit]) -> lsp.WorkspaceEdit:
        """Return edits in all files, in the form of the protocol."""
        changes: dict[str, list[lsp.TextEdit]] = {}
        for edit in edits:
            place = self.location(Place(span=edit.span, taught=edit.taught, file=edit.file))
            changes.setdefault(place.uri, []).append(lsp.TextEdit(range=place.range, new_text=edit.text))
        return lsp.WorkspaceEdit(changes=changes)

    def requires(self, uri: str) -> bool:
        """Return True if the script requires the file with the address `uri`."""
        return uri in map(self._uri, self.document.whole.required)

    def _taught_text(self, file: Path) -> str:
        """Return the text of the taught file. If the file is open in the editor, the text comes from the editor. The
        text is empty if there is no such file.
        """
        if not is_there(file):
            return ""
        self.taught_uri = from_fs_path(str(file)) or ""
        opened = self._workspace.text_documents.get(self.taught_uri)
        return read_source(file).text if opened is None else opened.source

    def _uri(self, text: Source) -> str:
        return self._uri_of(text.key) if text.key else self.uri

    def _uri_of(self, key: str) -> str:
        assert self._folder is not None
        return from_fs_path(os.path.normpath(self._folder / key)) or ""

    def _read(self, key: str) -> str:
        """Return the text of a required file. If the file is open in the editor, the text comes from the editor."""
        opened = self._workspace.text_documents.get(self._uri_of(key))
        assert self._folder is not None
        return read_source(self._folder / key).text if opened is None else opened.source

    @property
    def _taught(self) -> Source:
        """The taught file."""
        return Source(name="", text=self.document.taught_text)
