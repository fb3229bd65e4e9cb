"""The language server, driven over its standard input and output by a client."""

import asyncio
import json
import re
import subprocess
import sys
from collections.abc import Awaitable, Callable
from pathlib import Path

import pytest
from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException
from pygls.lsp.client import LanguageClient

from handeye.core.codes import CODES
from handeye.core.diagnostics import Diagnostic, Label
from handeye.core.source import Span
from handeye.editor import protocol, wire

TAUGHT = """\
[positions]
PARK = { at = [20.0, 28.0, 8.0, 90, 90, 0] }
HOLE = { at = [25.0, 38.0, 4.0, 90, 90, 0] }
FAR = { at = [200.0, 38.0, 4.0, 90, 90, 0] }
"""
SCRIPT = """\
        STAGE   "look 🔭"
        PARK
        JUMP    L1
L1:     MOVE    HOLE
"""


class Client(LanguageClient):
    """Keeps what is published, and opens one script."""

    def __init__(self, folder: Path) -> None:
        super().__init__("test", "1")
        self.published: asyncio.Queue[lsp.PublishDiagnosticsParams] = asyncio.Queue()
        self.feature(lsp.TEXT_DOCUMENT_PUBLISH_DIAGNOSTICS)(lambda params: self.published.put_nowait(params))
        self.script, self.taught = folder / "a.al", folder / "a.toml"
        self.document = lsp.TextDocumentIdentifier(uri=self.script.as_uri())
        self.version = 1

    async def open(self, text: str) -> list[lsp.Diagnostic]:
        item = lsp.TextDocumentItem(uri=self.document.uri, language_id="armal", version=1, text=text)
        self.text_document_did_open(lsp.DidOpenTextDocumentParams(text_document=item))
        return await self.diagnostics()

    async def type(self, line: int, start: int, end: int, text: str) -> list[lsp.Diagnostic]:
        self.version += 1
        changed = lsp.VersionedTextDocumentIdentifier(uri=self.document.uri, version=self.version)
        place = lsp.Range(start=lsp.Position(line, start), end=lsp.Position(line, end))
        change = lsp.TextDocumentContentChangePartial(range=place, text=text)
        params = lsp.DidChangeTextDocumentParams(text_document=changed, content_changes=[change])
        self.text_document_did_change(params)
        return await self.diagnostics()

    async def diagnostics(self) -> list[lsp.Diagnostic]:
        """The next that are about the text as it is now."""
        while (published := await self.published.get()).version != self.version:
            pass
        return list(published.diagnostics)


def talk(folder: Path, conversation: Callable[[Client], Awaitable[None]]) -> None:
    """Start a server, hold a conversation, say goodbye; the server ends by itself."""

    async def whole() -> int | None:
        client = Client(folder)
        await client.start_io(sys.executable, "-m", "handeye", "lsp")
        abilities = lsp.ClientCapabilities()
        root = folder.as_uri()
        await client.initialize_async(lsp.InitializeParams(capabilities=abilities, root_uri=root))
        client.initialized(lsp.InitializedParams())
        await conversation(client)
        await client.shutdown_async(None)
        client.exit(None)
        assert client._server is not None
        code = await client._server.wait()
        await client.stop()
        return code

    assert asyncio.run(whole()) == 0


@pytest.fixture
def folder(tmp_path: Path) -> Path:
    (tmp_path / "a.toml").write_text(TAUGHT, encoding="utf-8")
    return tmp_path


def test_what_could_be_left_out_is_marked_as_such() -> None:
    primary = Label(span=Span(start=0, end=1))
    shown = {
        code: wire.diagnostic(Diagnostic(code=code, message="", primary=primary), span(0, 0, 1), [])
        for code in CODES
    }
    marked = {code for code, found in shown.items() if found.tags == [lsp.DiagnosticTag.Unnecessary]}
    assert marked == {"unreachable-code", *(code for code in CODES if code.startswith("unused-"))}


@pytest.mark.slow
def test_diagnostics_come_as_one_types_and_the_planner_s_after_a_pause(folder: Path) -> None:
    async def conversation(client: Client) -> None:
        assert await client.open(SCRIPT) == []
        assert [d.code for d in await client.type(3, 16, 20, "HOLLE")] == ["unknown-position"]
        assert await client.type(3, 16, 21, "FAR") == []
        (far,) = await client.diagnostics()
        assert (far.code, far.range.start, far.range.end) == (
            "unreachable-position",
            lsp.Position(3, 16),
            lsp.Position(3, 19),
        )
        assert await client.type(3, 16, 19, "HOLE") == []

    talk(folder, conversation)


@pytest.mark.slow
def test_a_taught_file_that_cannot_be_used_is_one_diagnostic(folder: Path) -> None:
    (folder / "a.toml").write_text("[positions", encoding="utf-8")

    async def conversation(client: Client) -> None:
        (only,) = await client.open(SCRIPT)
        assert "a.toml is not TOML" in only.message
        client.taught.write_text(TAUGHT, encoding="utf-8")
        client.workspace_did_change_watched_files(lsp.DidChangeWatchedFilesParams(changes=[]))
        assert await client.diagnostics() == []

    talk(folder, conversation)


@pytest.mark.slow
def test_what_is_asked_wrongly_is_answered_in_a_sentence_and_logged_in_a_line(tmp_path: Path) -> None:
    at, never = {"line": 0, "character": 0}, {"uri": (tmp_path / "never.al").as_uri()}
    change = {"textDocument": {**never, "version": 2}, "contentChanges": [{"text": ""}]}
    untitled = {"uri": "untitled:1"}
    messages = [
        {"id": 1, "method": "initialize", "params": {"processId": None, "rootUri": None, "capabilities": {}}},
        {"method": "textDocument/didOpen", "params": {"textDocument": 5}},
        {"method": "textDocument/didChange", "params": change},
        {"id": 2, "method": "textDocument/hover", "params": {"textDocument": never, "position": at}},
        {"id": 3, "method": "textDocument/completion", "params": {"textDocument": untitled, "position": at}},
        {
            "id": 4,
            "method": "textDocument/hover",
            "params": {"textDocument": never, "position": {"line": -1}},
        },
        {"id": 5, "method": "textDocument/rename", "params": None},
        {"id": 6, "method": "shutdown"},
        {"method": "exit"},
    ]
    bodies = [json.dumps({"jsonrpc": "2.0", **message}).encode() for message in messages]
    sent = b"".join(b"Content-Length: %d\r\n\r\n%s" % (len(body), body) for body in bodies)
    done = subprocess.run(
        [sys.executable, "-m", "handeye", "lsp"], input=sent, capture_output=True, check=False
    )
    heads = re.split(rb"Content-Length: \d+\r\n(?:Content-Type: [^\r]*\r\n)?\r\n", done.stdout)[1:]
    answers = {body["id"]: body for body in map(json.loads, heads) if "id" in body}
    assert "never.al: there is no such file" in answers[2]["error"]["message"]
    assert answers[3]["error"]["message"] == "untitled:1 is not open in the editor"
    for wrong in (4, 5):
        assert "do not have the types that the protocol requires" in answers[wrong]["error"]["message"]
    assert (done.returncode, b"Traceback" in done.stderr) == (0, False)


@pytest.mark.slow
@pytest.mark.parametrize("reaped", [True, False])
def test_it_ends_with_the_editor_s_process_though_its_pipe_is_held_open(
    reaped: bool, monkeypatch: pytest.MonkeyPatch
) -> None:
    editor = subprocess.Popen([sys.executable, "-c", ""])
    if reaped:
        editor.wait()
    ended: list[int] = []
    monkeypatch.setattr(protocol, "PAUSE_S", 0.01)
    monkeypatch.setattr("os._exit", ended.append)
    asyncio.run(protocol.end_with(editor.pid))
    assert ended == [1]
    editor.wait()


@pytest.mark.slow
def test_every_question_an_editor_asks_is_answered_and_a_word_of_the_language_is_not_renamed(
    folder: Path,
) -> None:
    async def conversation(client: Client) -> None:
        await client.open(SCRIPT)
        document, at = client.document, lsp.Position(3, 17)
        hover = await client.text_document_hover_async(lsp.HoverParams(document, at))
        assert hover is not None
        assert "position `HOLE`" in str(hover.contents)
        assert "(25, 38, 4) in" in str(hover.contents)
        proposed = await client.text_document_completion_async(lsp.CompletionParams(document, at))
        assert proposed is not None
        assert not isinstance(proposed, lsp.CompletionList)
        assert [item.label for item in proposed] == ["FAR", "HOLE", "PARK"]
        made = await client.text_document_definition_async(lsp.DefinitionParams(document, at))
        assert list(made or ()) == [lsp.Location(client.taught.as_uri(), span(2, 0, 4))]
        used = await client.text_document_references_async(
            lsp.ReferenceParams(
                context=lsp.ReferenceContext(include_declaration=False),
                text_document=document,
                position=lsp.Position(2, 16),
            )
        )
        assert list(used or ()) == [lsp.Location(document.uri, span(2, 16, 18))]
        renamed = await client.text_document_rename_async(lsp.RenameParams(document, at, "BORE"))
        assert renamed is not None
        assert changes(renamed) == {
            document.uri: [lsp.TextEdit(span(3, 16, 20), "BORE")],
            client.taught.as_uri(): [lsp.TextEdit(span(2, 0, 4), "BORE")],
        }
        rename = lsp.RenameParams(document, lsp.Position(1, 9), "HOME")
        with pytest.raises(JsonRpcException, match="`PARK` is a word of the language"):
            await client.text_document_rename_async(rename)
        symbols = await client.text_document_document_symbol_async(lsp.DocumentSymbolParams(document))
        assert symbols is not None
        (stage,) = symbols
        assert isinstance(stage, lsp.DocumentSymbol)
        assert (stage.name, [part.name for part in stage.children or ()]) == ("look 🔭", ["L1"])

    talk(folder, conversation)


STAGES = """\
        OPEN    1
        STAGE   "one"
        PARK
        STAGE   "two"
        MOVE    HOLE
"""


@pytest.mark.slow
def test_above_each_stage_it_is_run_run_from_there_or_stepped(folder: Path) -> None:
    async def conversation(client: Client) -> None:
        async def lenses() -> list[lsp.CodeLens]:
            params = lsp.CodeLensParams(client.document)
            return list(await client.text_document_code_lens_async(params) or ())

        assert await client.open(STAGES) == []
        found = [
            (
                each.range.start.line,
                each.command.title,
                each.command.command,
                list(each.command.arguments or ()),
            )
            for each in await lenses()
            if each.command is not None
        ]
        file = str(client.script)
        assert found[-3:] == [
            (3, "Run", "handeye.run", [file, ["run", file, "--stage", "3"]]),
            (3, "Run from here", "handeye.runFromHere", [file, ["run", file, "--from", "3"]]),
            (3, "Debug", "handeye.debug", [file, ["run", file, "--step", "--from", "3"]]),
        ]
        assert [line for line, *_ in found] == [0, 0, 0, 1, 1, 1, 3, 3, 3]
        await client.type(4, 16, 20, "HOLLE")
        assert await lenses() == []  # a script with an error cannot be run

    talk(folder, conversation)


@pytest.mark.slow
def test_a_mistake_of_a_required_file_is_told_where_that_is_required(folder: Path) -> None:
    required = folder / "b.al"
    required.write_text("DEFINE M\nPARK\n\nOPNE 1\n", encoding="utf-8")

    async def conversation(client: Client) -> None:
        (wrong,) = await client.open("M\n        REQUIRE b.al\n")
        assert (wrong.code, wrong.range) == ("unknown-instruction", span(1, 16, 20))
        assert wrong.message == "b.al:4: there is no instruction `OPNE`\nhelp: did you mean `OPEN`?"
        (place,) = wrong.related_information or ()
        assert place.location == lsp.Location(required.as_uri(), span(3, 0, 4))
        at = lsp.DefinitionParams(client.document, lsp.Position(0, 0))
        made = await client.text_document_definition_async(at)
        assert list(made or ()) == [lsp.Location(required.as_uri(), span(0, 7, 8))]
        item = lsp.TextDocumentItem(
            uri=required.as_uri(), language_id="armal", version=1, text="DEFINE M\nPARK\n\nOPEN 1\n"
        )
        client.text_document_did_open(lsp.DidOpenTextDocumentParams(text_document=item))
        client.workspace_did_change_watched_files(lsp.DidChangeWatchedFilesParams(changes=[]))
        while (published := await client.published.get()).uri != client.document.uri:
            pass
        assert list(published.diagnostics) == []

    talk(folder, conversation)


@pytest.mark.slow
def test_quick_fixes_and_formatting_come_as_edits(folder: Path) -> None:
    async def conversation(client: Client) -> None:
        (wrong,) = await client.open('STAGE "🔭" MOVE\npark\n')
        assert (wrong.code, wrong.range) == ("too-many-operands", span(0, 11, 15))
        context = lsp.CodeActionContext(diagnostics=[wrong])
        document = client.document
        actions = await client.text_document_code_action_async(
            lsp.CodeActionParams(document, wrong.range, context)
        )
        assert actions is not None
        (action,) = actions
        assert isinstance(action, lsp.CodeAction)
        assert action.edit is not None
        assert changes(action.edit) == {document.uri: [lsp.TextEdit(span(0, 10, 15), "")]}
        options = lsp.FormattingOptions(tab_size=8, insert_spaces=True)
        edits = await client.text_document_formatting_async(lsp.DocumentFormattingParams(document, options))
        assert edits is not None
        assert [edit.new_text for edit in edits] == ['        STAGE   "🔭" MOVE\n        PARK\n']

    talk(folder, conversation)


@pytest.mark.slow
def test_the_server_ends_quietly_when_its_client_has_gone() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "handeye", "lsp"], input=b"", capture_output=True, check=False
    )
    assert (done.returncode, done.stdout, done.stderr) == (0, b"", b"")


def span(line: int, start: int, end: int) -> lsp.Range:
    return lsp.Range(start=lsp.Position(line, start), end=lsp.Position(line, end))


def changes(edit: lsp.WorkspaceEdit) -> dict[str, list[lsp.TextEdit]]:
    return {uri: list(edits) for uri, edits in (edit.changes or {}).items()}
