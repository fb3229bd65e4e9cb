"""The language server."""

import asyncio
from typing import Final

from lsprotocol import types as lsp
from pygls.lsp.server import LanguageServer

from handeye.core.diagnostics import Diagnostic
from handeye.core.source import Source, Span
from handeye.core.versions import HANDEYE
from handeye.editor import wire
from handeye.editor.checking import planning
from handeye.editor.script import EditedScript
from handeye.program.language import OwnLanguage, own_language
from handeye.program.taught import Taught

PAUSE_S: Final = 0.3
"""Time without a keystroke before motions are planned; other diagnostics are sent at once."""


class ArmServer(LanguageServer):
    """The server, with the planner's diagnostics of each script and the text they are for."""

    def __init__(self) -> None:
        super().__init__("handeye", HANDEYE)
        self.planned: dict[str, tuple[Source, Taught, list[Diagnostic]]] = {}

    def script(self, uri: str) -> EditedScript:
        """A script as it is now."""
        return EditedScript(self.workspace, uri)

    def diagnostics(self, script: EditedScript) -> list[Diagnostic]:
        """Current diagnostics of a script, the planner's only if they are for this text."""
        whole, taught, problems = self.planned.get(script.uri, (None, None, []))
        known = problems if (whole, taught) == (script.document.whole, script.document.taught) else []
        return [*script.diagnostics(), *known]

    def publish(self, script: EditedScript) -> None:
        """Publish the diagnostics of a script."""
        found = [script.published(problem) for problem in self.diagnostics(script)]
        if script.problem is not None:
            start = script.range(Span(start=0, end=0))
            found.append(lsp.Diagnostic(range=start, message=script.problem, source="handeye"))
        self.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(uri=script.uri, version=script.version, diagnostics=found)
        )

    async def publish_own(self, uri: str, language: OwnLanguage) -> None:
        """Tell the client what a system says about a text in its own language."""
        text = self.workspace.get_text_document(uri)
        source, units = Source(name=uri, text=text.source), text.position_codec.client_num_units
        found = [
            wire.diagnostic(problem, wire.range_(source, problem.primary.span, units), ())
            for problem in await asyncio.to_thread(language.check, source)
        ]
        self.text_document_publish_diagnostics(
            lsp.PublishDiagnosticsParams(uri=uri, version=text.version, diagnostics=found)
        )

    async def check(self, uri: str) -> None:
        """Publish diagnostics of the text, then the planner's after a pause in typing."""
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
