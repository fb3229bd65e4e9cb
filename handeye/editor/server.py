"""The language server: what it stores about each script, and how it answers an editor's requests."""

import asyncio
from collections.abc import Callable
from typing import Any, Final

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcInvalidParams
from pygls.lsp.server import LanguageServer

from handeye.al.formatter import format_text
from handeye.core.diagnostics import Diagnostic
from handeye.core.errors import InvalidInput
from handeye.core.source import Source, Span
from handeye.core.versions import HANDEYE
from handeye.editor import wire
from handeye.editor.checking import planning
from handeye.editor.completion import completions
from handeye.editor.fixes import fixes
from handeye.editor.hover import hover
from handeye.editor.navigation import FIRST, STAGE, Symbol, definition, outline, references, renamable, rename
from handeye.editor.protocol import Protocol, end_with, log_in_lines
from handeye.editor.script import EditedScript, text_of
from handeye.program.language import OwnLanguage, own_language
from handeye.program.taught import Taught

PAUSE_S: Final = 0.3
"""Time without a keystroke (s) after which motions are planned and diagnosed; all other diagnostics are sent
immediately.
"""


class ArmServer(LanguageServer):
    """The language server. For each script, it stores the planner's last diagnostics, and the text of the script from
    which they were computed.
    """

    def __init__(self) -> None:
        super().__init__("handeye", HANDEYE, protocol_cls=Protocol)
        self.planned: dict[str, tuple[Source, Taught, list[Diagnostic]]] = {}
        self.watching: asyncio.Future[None] | None = (
            None  # watches the editor's process, if the editor has named it
        )

    def script(self, uri: str) -> EditedScript:
        """Return a script in its present state."""
        return EditedScript(self.workspace, uri)

    def diagnostics(self, script: EditedScript) -> list[Diagnostic]:
        """Return the present diagnostics of a script. The planner's diagnostics are included only if they were
        computed for the present text.
        """
        whole, taught, problems = self.planned.get(script.uri, (None, None, []))
        known = problems if (whole, taught) == (script.document.whole, script.document.taught) else []
        return [*script.diagnostics(), *known]

    def publish(self, script: EditedScript) -> None:
        """Send the client the diagnostics of a script."""
        found = [script.published(problem) for problem in self.diagnostics(script)]
        if script.problem is not None:
            start = script.range(Span(start=0, end=0))
            found.append(lsp.Diagnostic(range=start, message=script.problem, source="handeye"))
        self.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(uri=script.uri, version=script.version, diagnostics=found)
        )

    async def publish_own(self, uri: str, language: OwnLanguage) -> None:
        """Send the client the diagnostics of a text in a system's own language."""
        text = text_of(self.workspace, uri)
        source, units = Source(name=uri, text=text.source), text.position_codec.client_num_units
        found = [
            wire.diagnostic(problem, wire.range_(source, problem.primary.span, units), ())
            for problem in await asyncio.to_thread(language.check, source)
        ]
        self.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(uri=uri, version=text.version, diagnostics=found)
        )

    async def check(self, uri: str) -> None:
        """Send the client the diagnostics of the text immediately, and the planner's diagnostics after a pause in
        typing.
        """
        if (language := own_language(uri)) is not None:
            await self.publish_own(uri, language)
            return
        script = self.script(uri)
        self.publish(script)
        program = None if script.problem is not None else script.document.compiled[0]
        if program is None:
            return
        await asyncio.sleep(PAUSE_S)
        if self._is_old(script):
            return
        problems = await asyncio.to_thread(planning, program)
        if not self._is_old(script):
            self.planned[uri] = (script.document.whole, script.document.taught, problems)
            self.publish(script)

    def _is_old(self, script: EditedScript) -> bool:
        documents = self.workspace.text_documents
        return script.uri not in documents or documents[script.uri].version != script.version


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
    """Read requests from standard input, and write answers to standard output, until the client ends the session."""
    log_in_lines()
    make_server().start_io()


def make_server() -> ArmServer:
    """Return a server with all its handlers."""
    server = ArmServer()
    for name, notice in _NOTICES.items():
        server.feature(name)(notice)
    answers = _ANSWERS | {name: _of_scripts(answer) for name, answer in _ANSWERS_ON_SCRIPTS.items()}
    for name, answer in answers.items():
        server.feature(name, _OPTIONS.get(name))(_told(answer))
    return server


def _of_scripts(answer: Callable[[EditedScript, Any], Any]) -> Callable[..., Any]:
    """Wrap a handler that works only for scripts in the arm language. For a text in another system's language, the
    answer is empty.
    """

    def answered(server: ArmServer, params: Any) -> Any:
        if own_language(params.text_document.uri) is not None:
            return None
        return answer(server.script(params.text_document.uri), params)

    return answered


def _told(answer: Callable[..., Any]) -> Callable[..., Any]:
    """Wrap a handler so that an error becomes a one-sentence message for the editor."""

    def told(server: ArmServer, params: Any) -> Any:
        try:
            return answer(server, params)
        except InvalidInput as error:
            raise JsonRpcInvalidParams(str(error)) from None

    return told


def _begun(server: ArmServer, params: lsp.InitializeParams) -> None:
    if params.process_id is not None:
        server.watching = asyncio.ensure_future(end_with(params.process_id))


async def _opened(server: ArmServer, params: lsp.DidOpenTextDocumentParams) -> None:
    await server.check(params.text_document.uri)


async def _changed(server: ArmServer, params: lsp.DidChangeTextDocumentParams) -> None:
    uri = params.text_document.uri
    requiring = [other for other in _scripts(server) if other != uri and server.script(other).requires(uri)]
    await asyncio.gather(*map(server.check, (uri, *requiring)))


async def _files_changed(server: ArmServer, _: lsp.DidChangeWatchedFilesParams) -> None:
    await asyncio.gather(*map(server.check, _scripts(server)))


def _scripts(server: ArmServer) -> list[str]:
    """Return the URIs of the open scripts."""
    return [uri for uri in server.workspace.text_documents if uri.endswith(".al")]


def _closed(server: ArmServer, params: lsp.DidCloseTextDocumentParams) -> None:
    uri = params.text_document.uri
    server.planned.pop(uri, None)
    server.text_document_publish_diagnostics(lsp.PublishDiagnosticsParams(uri=uri, diagnostics=[]))


def _hover(script: EditedScript, params: lsp.HoverParams) -> lsp.Hover | None:
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
    text = text_of(server.workspace, params.text_document.uri)
    source = Source(name=text.uri, text=text.source)
    at = wire.offset(source, params.position, text.position_codec.client_num_units)
    kind = lsp.CompletionItemKind.Keyword
    return [
        lsp.CompletionItem(label=word, kind=kind, detail=meaning)
        for word, meaning in language.words(source, at)
    ]


def _definition(script: EditedScript, params: lsp.DefinitionParams) -> list[lsp.Location]:
    return [script.location(f) for f in definition(script.document, script.offset(params.position))]


def _references(script: EditedScript, params: lsp.ReferenceParams) -> list[lsp.Location]:
    at = script.offset(params.position)
    made = [] if params.context.include_declaration else definition(script.document, at)
    return [script.location(f) for f in references(script.document, at) if f not in made]


def _prepare_rename(script: EditedScript, params: lsp.PrepareRenameParams) -> lsp.Range:
    return script.range(renamable(script.document, script.offset(params.position)).span)


def _rename(script: EditedScript, params: lsp.RenameParams) -> lsp.WorkspaceEdit:
    return script.edit(rename(script.document, script.offset(params.position), params.new_name))


def _format(script: EditedScript, _: lsp.DocumentFormattingParams) -> list[lsp.TextEdit]:
    text = script.document.text
    tidy = format_text(text)
    whole = script.range(Span(start=0, end=len(text)))
    return [] if tidy == text else [lsp.TextEdit(range=whole, new_text=tidy)]


def _symbols(script: EditedScript, _: lsp.DocumentSymbolParams) -> list[lsp.DocumentSymbol]:

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


def _code_actions(server: ArmServer, params: lsp.CodeActionParams) -> list[lsp.CodeAction] | None:
    if own_language(params.text_document.uri) is not None:
        return None
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


def _lenses(script: EditedScript, _: lsp.CodeLensParams) -> list[lsp.CodeLens]:
    """Return the commands that are shown above each stage of an error-free script. One command runs the stage, one
    runs the program from the stage on, and one steps through the stage.

    A command has two arguments: the file, which the editor saves first, and the words that follow `handeye` on the
    command line.
    """
    program = script.document.compiled[0]
    if program is None or script.path is None or script.problem is not None:
        return []
    names = {found.name: found.at.start for found in outline(script.document) if found.kind == STAGE}
    names[FIRST] = 0
    return [
        lsp.CodeLens(
            range=script.range(Span(start=names[stage], end=names[stage])),
            command=lsp.Command(
                title=title,
                command=command,
                tooltip=tooltip,
                arguments=[script.path, ["run", script.path, *options, str(number)]],
            ),
        )
        for number, stage in enumerate(program.stages, 1)
        if stage in names  # else it is in a required file
        for title, (command, tooltip, options) in _STAGE_COMMANDS.items()
    ]


_STAGE_COMMANDS: Final = {
    "Run": ("handeye.run", "Run the program up to the end of this stage.", ("--stage",)),
    "Run from here": ("handeye.runFromHere", "Run the program from this stage on.", ("--from",)),
    "Debug": ("handeye.debug", "Step through the program from this stage on.", ("--step", "--from")),
}
"""For each title that the editor shows above a stage: the command, the tooltip, and the options for `handeye run`."""


_NOTICES: Final[dict[str, Callable[..., Any]]] = {
    lsp.INITIALIZE: _begun,
    lsp.TEXT_DOCUMENT_DID_OPEN: _opened,
    lsp.TEXT_DOCUMENT_DID_CHANGE: _changed,
    lsp.TEXT_DOCUMENT_DID_CLOSE: _closed,
    lsp.WORKSPACE_DID_CHANGE_WATCHED_FILES: _files_changed,
}
_ANSWERS: Final[dict[str, Callable[..., Any]]] = {
    lsp.TEXT_DOCUMENT_COMPLETION: _completion,
    lsp.TEXT_DOCUMENT_CODE_ACTION: _code_actions,
}  # about texts in languages of other systems, too
_ANSWERS_ON_SCRIPTS: Final[dict[str, Callable[[EditedScript, Any], Any]]] = {
    lsp.TEXT_DOCUMENT_HOVER: _hover,
    lsp.TEXT_DOCUMENT_DEFINITION: _definition,
    lsp.TEXT_DOCUMENT_REFERENCES: _references,
    lsp.TEXT_DOCUMENT_PREPARE_RENAME: _prepare_rename,
    lsp.TEXT_DOCUMENT_RENAME: _rename,
    lsp.TEXT_DOCUMENT_FORMATTING: _format,
    lsp.TEXT_DOCUMENT_DOCUMENT_SYMBOL: _symbols,
    lsp.TEXT_DOCUMENT_CODE_LENS: _lenses,
}
_OPTIONS: Final[dict[str, Any]] = {
    lsp.TEXT_DOCUMENT_CODE_ACTION: lsp.CodeActionOptions(code_action_kinds=[lsp.CodeActionKind.QuickFix]),
    lsp.TEXT_DOCUMENT_RENAME: lsp.RenameOptions(prepare_provider=True),
    lsp.TEXT_DOCUMENT_COMPLETION: lsp.CompletionOptions(trigger_characters=[" "]),
}
