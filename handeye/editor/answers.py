"""Handlers of an editor's requests."""

import asyncio
from collections.abc import Callable
from functools import wraps
from typing import Any, Final

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams

from handeye.al.formatter import format_text
from handeye.core.errors import InvalidInput
from handeye.core.source import Source, Span
from handeye.editor import wire
from handeye.editor.completion import completions
from handeye.editor.fixes import fixes
from handeye.editor.hover import hover
from handeye.editor.navigation import STAGE, Symbol, definition, outline, references, renamable, rename
from handeye.editor.server import ArmServer
from handeye.program.language import OwnLanguage, own_language

_PROPOSED: Final = {
    "instruction": lsp.CompletionItemKind.Function,
    "word": lsp.CompletionItemKind.Keyword,
    "number": lsp.CompletionItemKind.Value,
    "macro": lsp.CompletionItemKind.Snippet,
    "label": lsp.CompletionItemKind.Reference,
}
_SYMBOLS: Final = {
    STAGE: lsp.SymbolKind.Module,
    "macro": lsp.SymbolKind.Function,
    "label": lsp.SymbolKind.Key,
    "picture": lsp.SymbolKind.File,
}


def serve() -> None:
    """Serve requests from standard input on standard output until the client ends."""
    make_server().start_io()


def make_server() -> ArmServer:
    """A server with all handlers."""
    server = ArmServer()
    for name, answer in _ANSWERS.items():
        server.feature(name, _OPTIONS.get(name))(answer if name in _OF_ALL else _of_scripts(answer))
    return server


def _of_scripts(answer: Callable[..., Any]) -> Callable[..., Any]:
    """An answer about scripts for planned programs; of a text in a system's own language nothing is known here."""

    @wraps(answer)
    def answered(server: ArmServer, params: Any) -> Any:
        return answer(server, params) if own_language(params.text_document.uri) is None else None

    return answered


async def _opened(server: ArmServer, params: lsp.DidOpenTextDocumentParams) -> None:
    await server.check(params.text_document.uri)


async def _changed(server: ArmServer, params: lsp.DidChangeTextDocumentParams) -> None:
    uri = params.text_document.uri
    requiring = [other for other in _scripts(server) if other != uri and server.script(other).requires(uri)]
    await asyncio.gather(*map(server.check, (uri, *requiring)))


async def _files_changed(server: ArmServer, _: lsp.DidChangeWatchedFilesParams) -> None:
    await asyncio.gather(*map(server.check, _scripts(server)))


def _scripts(server: ArmServer) -> list[str]:
    """The open scripts."""
    return [uri for uri in server.workspace.text_documents if uri.endswith(".al")]


def _closed(server: ArmServer, params: lsp.DidCloseTextDocumentParams) -> None:
    uri = params.text_document.uri
    server.planned.pop(uri, None)
    server.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri=uri, diagnostics=[]))


def _hover(server: ArmServer, params: lsp.HoverParams) -> lsp.Hover | None:
    script = server.script(params.text_document.uri)
    found = hover(script.document, script.offset(params.position))
    if found is None:
        return None
    contents = lsp.MarkupContent(kind=lsp.MarkupKind.Markdown, value=found.text)
    return lsp.Hover(contents=contents, range=script.range(found.span))


def _completion(server: ArmServer, params: lsp.CompletionParams) -> list[lsp.CompletionItem]:
    if (language := own_language(params.text_document.uri)) is not None:
        return _own_words(server, language, params)
    script = server.script(params.text_document.uri)
    span, proposals = completions(script.document, script.offset(params.position))
    return [
        lsp.CompletionItem(
            label=proposal.text,
            kind=_PROPOSED.get(proposal.kind, lsp.CompletionItemKind.Variable),
            detail=proposal.detail,
            documentation=proposal.help or None,
            text_edit=lsp.TextEdit(range=script.range(span), new_text=proposal.text),
        )
        for proposal in proposals
    ]


def _own_words(
    server: ArmServer, language: OwnLanguage, params: lsp.CompletionParams
) -> list[lsp.CompletionItem]:
    text = server.workspace.get_text_document(params.text_document.uri)
    source = Source(name=text.uri, text=text.source)
    at = wire.offset(source, params.position, text.position_codec.client_num_units)
    kind = lsp.CompletionItemKind.Keyword
    return [
        lsp.CompletionItem(label=word, kind=kind, detail=meaning)
        for word, meaning in language.words(source, at)
    ]


def _definition(server: ArmServer, params: lsp.DefinitionParams) -> list[lsp.Location]:
    script = server.script(params.text_document.uri)
    return [script.location(f) for f in definition(script.document, script.offset(params.position))]


def _references(server: ArmServer, params: lsp.ReferenceParams) -> list[lsp.Location]:
    script = server.script(params.text_document.uri)
    at = script.offset(params.position)
    made = [] if params.context.include_declaration else definition(script.document, at)
    return [script.location(f) for f in references(script.document, at) if f not in made]


def _prepare_rename(server: ArmServer, params: lsp.PrepareRenameParams) -> lsp.Range:
    script = server.script(params.text_document.uri)
    try:
        return script.range(renamable(script.document, script.offset(params.position)).span)
    except InvalidInput as error:
        raise JsonRpcInvalidParams(str(error)) from None


def _rename(server: ArmServer, params: lsp.RenameParams) -> lsp.WorkspaceEdit:
    script = server.script(params.text_document.uri)
    try:
        return script.edit(rename(script.document, script.offset(params.position), params.new_name))
    except InvalidInput as error:
        raise JsonRpcInvalidParams(str(error)) from None


def _format(server: ArmServer, params: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
    script = server.script(params.text_document.uri)
    text = script.document.text
    tidy = format_text(text)
    whole = script.range(Span(start=0, end=len(text)))
    return [] if tidy == text else [lsp.TextEdit(range=whole, new_text=tidy)]


def _symbols(server: ArmServer, params: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:
    script = server.script(params.text_document.uri)

    def symbol(found: Symbol) -> lsp.DocumentSymbol:
        return lsp.DocumentSymbol(
            name=found.name,
            kind=_SYMBOLS.get(found.kind, lsp.SymbolKind.Variable),
            detail=found.kind,
            range=script.range(found.span),
            selection_range=script.range(found.at),
            children=[symbol(part) for part in found.parts],
        )

    return [symbol(found) for found in outline(script.document)]


def _code_actions(server: ArmServer, params: lsp.CodeActionParams) -> list[lsp.CodeAction]:
    script = server.script(params.text_document.uri)
    first, last = script.offset(params.range.start), script.offset(params.range.end)
    actions = []
    for found in server.diagnostics(script):
        span = found.primary.span
        if span.end < first or span.start > last:
            continue
        cured = script.published(found)
        for number, fix in enumerate(fixes(script.document, found)):
            actions.append(
                lsp.CodeAction(
                    title=fix.title,
                    kind=lsp.CodeActionKind.QuickFix,
                    diagnostics=[cured],
                    edit=script.edit(fix.edits),
                    is_preferred=number == 0 and not fix.choice,
                )
            )
    return actions


_ANSWERS: Final[dict[str, Callable[..., Any]]] = {
    lsp.TEXT_DOCUMENT_DID_OPEN: _opened,
    lsp.TEXT_DOCUMENT_DID_CHANGE: _changed,
    lsp.TEXT_DOCUMENT_DID_CLOSE: _closed,
    lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES: _files_changed,
    lsp.TEXT_DOCUMENT_HOVER: _hover,
    lsp.TEXT_DOCUMENT_COMPLETION: _completion,
    lsp.TEXT_DOCUMENT_DEFINITION: _definition,
    lsp.TEXT_DOCUMENT_REFERENCES: _references,
    lsp.TEXT_DOCUMENT_PREPARE_RENAME: _prepare_rename,
    lsp.TEXT_DOCUMENT_RENAME: _rename,
    lsp.TEXT_DOCUMENT_FORMATTING: _format,
    lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL: _symbols,
    lsp.TEXT_DOCUMENT_CODE_ACTION: _code_actions,
}  # handlers of requests and notifications
_OF_ALL: Final = {
    lsp.TEXT_DOCUMENT_DID_OPEN,
    lsp.TEXT_DOCUMENT_DID_CHANGE,
    lsp.TEXT_DOCUMENT_DID_CLOSE,
    lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES,
    lsp.TEXT_DOCUMENT_COMPLETION,
}  # what is answered about texts in languages of other systems, too
_OPTIONS: Final[dict[str, Any]] = {
    lsp.TEXT_DOCUMENT_CODE_ACTION: lsp.CodeActionOptions(code_action_kinds=[lsp.CodeActionKind.QuickFix]),
    lsp.TEXT_DOCUMENT_RENAME: lsp.RenameOptions(prepare_provider=True),
    lsp.TEXT_DOCUMENT_COMPLETION: lsp.CompletionOptions(trigger_characters=[" "]),
}
