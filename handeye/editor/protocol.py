"""What the language server answers to an editor that breaks the protocol, or that has gone."""

import asyncio
import logging
import os
import sys
from pathlib import Path
from typing import Any, Final

from lsprotocol import types as lsp
from pygls.exceptions import JsonRpcException, JsonRpcInvalidParams
from pygls.protocol import LanguageServerProtocol

PAUSE_S: Final = 3.0
"""Time between two looks at whether the editor is still there."""
_log: Final = logging.getLogger(__name__)


class Protocol(LanguageServerProtocol):
    """Answers a request whose parameters cannot be used, too, and passes over notifications that cannot."""

    def structure_message(self, data: dict[str, Any]) -> Any:
        """A message by its kind, called by the JSON decoder for each object in it."""
        try:
            return super().structure_message(data)
        except JsonRpcException:
            why = f"the parameters of {data.get('method')} do not have the types of the protocol"
            if "id" in data:
                error = JsonRpcInvalidParams(why).to_response_error()
                self._send_response(data["id"], error=error)
            return lsp.SetTraceNotification(
                params=lsp.SetTraceParams(value=lsp.TraceValue.Off)
            )  # means nothing to us

    def handle_message(self, message: Any) -> None:
        """Pass a message on, unless it changes a text that was never opened."""
        if isinstance(message, lsp.DidChangeTextDocumentNotification):
            uri = message.params.text_document.uri
            if uri not in self.workspace.text_documents:
                _log.warning("%s was changed but is not open", uri)
                return
        super().handle_message(message)


class OneLine(logging.Formatter):
    """A line for each record; a traceback only of what is no mistake of the editor's."""

    def format(self, record: logging.LogRecord) -> str:
        """The record as text."""
        error = record.exc_info[1] if record.exc_info else None
        if error is not None and not isinstance(error, JsonRpcException):
            return super().format(record)
        said = record.getMessage().split("\n")[0]
        return said if error is None else f"{said}: {error}"


def log_in_lines() -> None:
    """Have what the libraries log go to standard error a line each."""
    lines = logging.StreamHandler()
    lines.setFormatter(OneLine())
    logging.basicConfig(handlers=[lines], level=logging.WARNING)


async def end_with(process: int) -> None:
    """End the server when a process has ended, also where another one holds its pipe open."""
    while is_running(process):
        await asyncio.sleep(PAUSE_S)
    os._exit(1)  # without the goodbye that the protocol asks for


def is_running(process: int) -> bool:
    """Whether a process has not ended; True where that cannot be known, as on Windows, where to ask would end it."""
    if sys.platform == "win32" or process <= 0:
        return True
    try:
        os.kill(process, 0)
        state = Path(f"/proc/{process}/stat").read_bytes().rpartition(b") ")[2][:1]
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):  # another user's process, or a system without /proc
        return True
    return state not in b"ZX"  # ended, and not yet asked how
