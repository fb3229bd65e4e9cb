"""Copes with editors that violate the language server protocol, or that have ended."""

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
"""Time (s) between two checks whether the editor is still running."""
_log: Final = logging.getLogger(__name__)


class Protocol(LanguageServerProtocol):
    """A protocol handler that replies with an error to a request whose parameters are invalid, and ignores invalid
    notifications.
    """

    def structure_message(self, data: dict[str, Any]) -> Any:
        """Make a typed message. The JSON decoder calls this method for each object in a message."""
        try:
            return super().structure_message(data)
        except JsonRpcException:
            why = f"the parameters of {data.get('method')} do not have the types that the protocol requires"
            if "id" in data:
                error = JsonRpcInvalidParams(why).to_response_error()
                self._send_response(data["id"], error=error)
            return lsp.SetTraceNotification(
                params=lsp.SetTraceParams(value=lsp.TraceValue.Off)
            )  # a notification that has no effect here

    def handle_message(self, message: Any) -> None:
        """Handle a message, unless it changes a text that was never opened."""
        if isinstance(message, lsp.DidChangeTextDocumentNotification):
            uri = message.params.text_document.uri
            if uri not in self.workspace.text_documents:
                _log.warning("%s was changed but is not open", uri)
                return
        super().handle_message(message)


class OneLine(logging.Formatter):
    """Formats each log record as one line. A traceback is added to an error, except to a `JsonRpcException`: a message
    from the user's editor causes this error.
    """

    def format(self, record: logging.LogRecord) -> str:
        """Return the log record as text."""
        error = record.exc_info[1] if record.exc_info else None
        if error is not None and not isinstance(error, JsonRpcException):
            return super().format(record)
        said = record.getMessage().split("\n")[0]
        return said if error is None else f"{said}: {error}"


def log_in_lines() -> None:
    """Send the log records of the server's libraries to standard error, one line per record."""
    lines = logging.StreamHandler()
    lines.setFormatter(OneLine())
    logging.basicConfig(handlers=[lines], level=logging.WARNING)


async def end_with(process: int) -> None:
    """End the server when the editor's process has ended, even if another process keeps the server's input open."""
    while is_running(process):
        await asyncio.sleep(PAUSE_S)
    os._exit(1)  # the client cannot send the `exit` that the protocol requires


def is_running(process: int) -> bool:
    """Return True if a process is running, or if handeye cannot determine whether it is. On Windows, handeye does not
    check, because the usual check would end the process.
    """
    if sys.platform == "win32" or process <= 0:
        return True
    try:
        os.kill(process, 0)
        state = Path(f"/proc/{process}/stat").read_bytes().rpartition(b") ")[2][:1]
    except ProcessLookupError:
        return False
    except (OSError, OverflowError):  # another user's process, or a system without /proc
        return True
    return state not in b"ZX"  # ended, but its parent has not yet read its status
