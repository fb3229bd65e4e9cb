"""A Chromium without a window, controlled through a pair of pipes, for tests of pages. It needs a Chromium on this
computer: the one that `HANDEYE_CHROMIUM` names, or one on the path.
"""

import base64
import json
import os
import shutil
import subprocess
import time
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass, field
from pathlib import Path
from subprocess import PIPE
from typing import Any, Self

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable")
FLAGS = (
    "--headless", "--no-sandbox", "--no-first-run", "--disable-quic", "--disable-background-networking",
    "--disable-component-update", "--disable-sync", "--use-gl=angle", "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist", "--remote-debugging-pipe",
)  # fmt: skip
_REDIRECTED = 'exec "$@" 3<&0 4>&1 0</dev/null 1>/dev/null 2>&1'
"""What a shell does for a command that reads from 3 and writes to 4, as Chromium does."""
PATIENCE = 120.0
"""s to wait for what should come; it comes in less than one."""


class NoChromium(Exception):
    """There is no Chromium, or it does not answer."""


def chromium() -> str:
    """The program.

    Raises:
        NoChromium: there is none.
    """
    found = os.environ.get("HANDEYE_CHROMIUM") or next(filter(None, map(shutil.which, NAMES)), None)
    if found is None:
        raise NoChromium("no Chromium on this machine; HANDEYE_CHROMIUM can name one")
    return found


@dataclass
class Pipe:
    """Commands to a browser, and its answers: JSON, each followed by a zero byte."""

    write: int
    read: int
    number: int = 0
    buffer: bytes = b""
    heard: list[dict[str, Any]] = field(default_factory=list)
    """Messages that the browser sent without being asked."""

    def ask(self, method: str, session: str | None = None, **words: Any) -> dict[str, Any]:
        """The answer to a command.

        Raises:
            NoChromium: it is a refusal, or the browser has ended.
        """
        self.number += 1
        asked = {"id": self.number, "method": method, "params": words}
        os.write(
            self.write, json.dumps({**asked, **({"sessionId": session} if session else {})}).encode() + b"\0"
        )
        while (told := self._next()).get("id") != self.number:
            self.heard.append(told)
        if "error" in told:
            raise NoChromium(f"{method}: {told['error']['message']}")
        return dict(told["result"])

    def _next(self) -> dict[str, Any]:
        while b"\0" not in self.buffer:
            more = os.read(self.read, 1 << 20)
            if not more:
                raise NoChromium("Chromium has ended")
            self.buffer += more
        message, _, self.buffer = self.buffer.partition(b"\0")
        return dict(json.loads(message))


@dataclass
class Page:
    """A page in the browser."""

    pipe: Pipe
    session: str

    def ask(self, method: str, **words: Any) -> dict[str, Any]:
        """The answer to a command about this page."""
        return self.pipe.ask(method, self.session, **words)

    def evaluate(self, expression: str) -> Any:
        """The value of an expression, or of the promise that it is.

        Raises:
            NoChromium: it throws.
        """
        told = self.ask("Runtime.evaluate", expression=expression, awaitPromise=True, returnByValue=True)
        if "exceptionDetails" in told:
            raise NoChromium(told["exceptionDetails"].get("exception", {}).get("description", str(told)))
        return told["result"].get("value")

    def wait(self, expression: str) -> Any:
        """The value of an expression as soon as it is true.

        Raises:
            NoChromium: it does not become so.
        """
        begun = time.monotonic()
        while not (value := self.evaluate(expression)):
            if time.monotonic() - begun > PATIENCE:
                raise NoChromium(f"{expression} does not become true; the page said {self.errors}")
            time.sleep(0.05)
        return value

    def screenshot(self) -> bytes:
        """Return a picture of the page as a PNG file."""
        return base64.b64decode(self.ask("Page.captureScreenshot", format="png")["data"])

    def press(self, x: float, y: float, *way: tuple[float, float], button: str = "left") -> None:
        """Press a button of the mouse at a point, move it through others, and let go."""
        self._mouse("mousePressed", x, y, button)
        for x, y in way:
            self._mouse("mouseMoved", x, y, button)
        self._mouse("mouseReleased", x, y, button)

    def _mouse(self, what: str, x: float, y: float, button: str) -> None:
        held = {"left": 1, "right": 2}[button]
        self.ask("Input.dispatchMouseEvent", type=what, x=x, y=y, button=button, buttons=held, clickCount=1)

    def wheel(self, x: float, y: float, down: float) -> None:
        """Turn the wheel of the mouse at a point."""
        self.ask("Input.dispatchMouseEvent", type="mouseWheel", x=x, y=y, deltaX=0, deltaY=down)
        self.evaluate("new Promise(requestAnimationFrame)")  # the page hears of it with the next frame

    def touch(self, what: str, *fingers: tuple[float, float]) -> None:
        """Fingers on the screen: `touchStart`, `touchMove` or `touchEnd`."""
        points = [{"x": x, "y": y, "id": number} for number, (x, y) in enumerate(fingers)]
        self.ask("Input.dispatchTouchEvent", type=what, touchPoints=points)

    def key(self, name: str, *, shift: bool = False) -> None:
        """Press a key, as `ArrowLeft`, and let go."""
        words = {"key": name, "modifiers": 8 if shift else 0, **({"text": name} if len(name) == 1 else {})}
        self.ask("Input.dispatchKeyEvent", type="keyDown", **words)
        self.ask("Input.dispatchKeyEvent", type="keyUp", key=name)

    def resize(self, width: int, height: int) -> None:
        """Change the size of the window."""
        self.ask(
            "Emulation.setDeviceMetricsOverride",
            width=width,
            height=height,
            deviceScaleFactor=1,
            mobile=False,
        )

    @property
    def errors(self) -> list[str]:
        """Errors in the page's console."""
        found = []
        for told in self._told():
            words = told["params"]
            if told["method"] == "Runtime.exceptionThrown":
                found.append(str(words["exceptionDetails"].get("exception", {}).get("description")))
            elif told["method"] == "Log.entryAdded" and words["entry"]["level"] == "error":
                found.append(words["entry"]["text"])
            elif told["method"] == "Runtime.consoleAPICalled" and words["type"] == "error":
                found.append(str(words["args"]))
        return found

    @property
    def requests(self) -> list[str]:
        """Addresses that the page requested from the network or the disk, without data in the page itself."""
        asked = [told for told in self._told() if told["method"] == "Network.requestWillBeSent"]
        urls = [told["params"]["request"]["url"] for told in asked]
        return [url for url in urls if not url.startswith(("data:", "blob:"))]

    def _told(self) -> Iterator[dict[str, Any]]:
        self.evaluate("0")  # all messages sent so far are read now
        return (told for told in self.pipe.heard if told.get("sessionId") == self.session)


@dataclass
class Browser:
    """A Chromium."""

    pipe: Pipe

    @classmethod
    @contextmanager
    def started(cls, profile: Path, *flags: str) -> Iterator[Self]:
        """One with an empty profile in a folder of its own, as long as it is needed.

        Raises:
            NoChromium: there is none.
        """
        command = [chromium(), *FLAGS, f"--user-data-dir={profile}", *flags]
        process = subprocess.Popen(["/bin/sh", "-c", _REDIRECTED, "sh", *command], stdin=PIPE, stdout=PIPE)
        assert process.stdin is not None
        assert process.stdout is not None
        with process, process.stdin, process.stdout:
            browser = cls(Pipe(process.stdin.fileno(), process.stdout.fileno()))
            try:
                yield browser
            finally:
                process.terminate()

    def page(self, path: Path, *, width: int = 870, height: int = 700) -> Page:
        """A page from the disk, with no network, in a window of a size."""
        target = self.pipe.ask("Target.createTarget", url="about:blank")["targetId"]
        session = self.pipe.ask("Target.attachToTarget", targetId=target, flatten=True)["sessionId"]
        page = Page(self.pipe, session)
        for domain in ("Page", "Runtime", "Log", "Network"):
            page.ask(f"{domain}.enable")
        offline = {"offline": True, "latency": 0, "downloadThroughput": 0, "uploadThroughput": 0}
        page.ask("Network.emulateNetworkConditions", **offline)
        page.resize(width, height)
        page.ask("Page.navigate", url=path.as_uri())
        page.wait("location.protocol === 'file:' && document.readyState === 'complete'")
        return page
