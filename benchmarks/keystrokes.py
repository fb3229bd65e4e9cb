"""Simulates an editor that types into a script, and waits after each key for the language server's diagnostics."""

import subprocess
import sys
import time
from types import TracebackType
from typing import Any, Final, Self

import msgspec

from handeye.core.errors import Refused

_URI: Final = "untitled:pins.al"


def typed(text: str, line: int, times: int) -> list[float]:
    """Return, for each of `times` keystrokes at the end of a line, the seconds until the diagnostics of the new text
    arrive.

    The server is a separate process. The time includes the pipes to it, and JSON at both ends.

    Args:
        line: counted from 1.
    """
    column = len(text.splitlines()[line - 1])
    with _Editor(text) as editor:
        return [editor.type(line - 1, column + k, "ABCDEFGH"[k % 8]) for k in range(times)]


class _Editor:
    """The editor's end of the language server protocol, with one open script."""

    def __init__(self, text: str) -> None:
        self.server = subprocess.Popen(
            [sys.executable, "-m", "handeye", "lsp"],
            stdin=subprocess.PIPE,
            stdout=subprocess.PIPE,
            stderr=subprocess.DEVNULL,
        )
        self.version = 0
        self._tell("initialize", {"capabilities": {}, "processId": None, "rootUri": None}, id=1)
        self._hear()
        self._tell("initialized", {})
        item = {"uri": _URI, "languageId": "armal", "version": self.version, "text": text}
        self._tell("textDocument/didOpen", {"textDocument": item})
        self._diagnostics()

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, error: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.server.kill()
        self.server.communicate()

    def type(self, line: int, column: int, key: str) -> float:
        """Type a key at a line and column, counted from 0, and return the seconds until the diagnostics arrive."""
        self.version += 1
        here = {"line": line, "character": column}
        begun = time.perf_counter()
        self._tell(
            "textDocument/didChange",
            {
                "textDocument": {"uri": _URI, "version": self.version},
                "contentChanges": [{"range": {"start": here, "end": here}, "text": key}],
            },
        )
        self._diagnostics()
        return time.perf_counter() - begun

    def _diagnostics(self) -> None:
        """Wait for the diagnostics of the present text."""
        while self._hear().get("params", {}).get("version") != self.version:
            pass

    def _tell(self, method: str, params: dict[str, Any], **more: int) -> None:
        assert self.server.stdin is not None
        body = msgspec.json.encode({"jsonrpc": "2.0", "method": method, "params": params, **more})
        self.server.stdin.write(b"Content-Length: %d\r\n\r\n%b" % (len(body), body))
        self.server.stdin.flush()

    def _hear(self) -> dict[str, Any]:
        assert self.server.stdout is not None
        size = 0
        while (header := self.server.stdout.readline()) not in (b"\r\n", b""):
            name, _, value = header.partition(b":")
            size = int(value) if name == b"Content-Length" else size
        if not size:
            raise Refused("the language server has ended; `handeye lsp` may say why")
        heard: dict[str, Any] = msgspec.json.decode(self.server.stdout.read(size))
        return heard
