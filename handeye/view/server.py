"""The server: a thread, parallel to the run, that delivers the page and sends messages to the viewers.

The server sends the newest state of the run `MOMENTS_PER_S` times per second, and drops all states in between. A
viewer that falls too far behind is disconnected, so that no viewer can slow the run down.
"""

import asyncio
import socket
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from http import HTTPStatus
from threading import Event, Thread
from typing import Annotated, Final, Self

import msgspec
from websockets.asyncio.server import Server as SocketServer
from websockets.asyncio.server import ServerConnection, serve
from websockets.datastructures import Headers
from websockets.exceptions import ConnectionClosed
from websockets.http11 import Request, Response

from handeye.core.errors import Refused
from handeye.view.access import HOST, LIVE, NOTHING, Access
from handeye.view.link import Link
from handeye.view.moment import Newest

MOMENTS_PER_S: Final = 25
MAX_MESSAGE_BYTES: Final = 4096  # greatest size of a viewer's message; a larger one ends the connection
MAX_LINE_CHARS: Final = 1000
KEPT_MESSAGES: Final = 400  # number of messages kept for viewers who come later
MAX_BEHIND: Final = 4 * KEPT_MESSAGES  # number of unsent messages at which a viewer is disconnected


class Say(msgspec.Struct, tag_field="do", tag="say", forbid_unknown_fields=True):
    """A viewer's request to send a line to the stepper."""

    line: Annotated[str, msgspec.Meta(max_length=MAX_LINE_CHARS)]


class Panic(msgspec.Struct, tag_field="do", tag="panic", forbid_unknown_fields=True):
    """A viewer's request to press the panic button. Every viewer may send this request."""


class Drive(msgspec.Struct, tag_field="do", tag="drive", forbid_unknown_fields=True):
    """A viewer's request to take control from the viewer who has it."""


Wish = Say | Panic | Drive
_WISHES: Final = msgspec.json.Decoder(Wish)


@dataclass(eq=False)
class Viewer:
    """A connected browser."""

    connection: ServerConnection
    waiting: deque[str] = field(default_factory=deque)  # messages that are not sent yet


class Server:
    """Serves one run, from the call of `show` until the server's context is left. The server takes its port when it is
    created, so that a port in use is reported immediately.
    """

    def __init__(self, link: Link, port: int = 0) -> None:
        """Take the port number `port`, or any free port if `port` is 0. Raises InvalidInput if the port is in
        use or unavailable.
        """
        self.link = link
        self._socket = _taken(port)
        self.access = Access(self._socket.getsockname()[1])
        self._viewers: list[Viewer] = []
        self._driver: Viewer | None = None
        self._told = deque[str](maxlen=KEPT_MESSAGES)
        self._loop = asyncio.new_event_loop()
        self._up = Event()

    def show(self, page: bytes, newest: Newest | None = None) -> None:
        """Start to serve a page and to send states of the run. If `newest` is None, only the page is served: no
        states are sent, and viewers cannot open a socket."""
        self._page, self._newest = page, newest
        self.link.tell = lambda text: self._call(lambda: self._tell(text))
        self._thread = Thread(
            target=lambda: self._loop.run_until_complete(self._serve()), name="viewers", daemon=True
        )
        self._thread.start()
        self._up.wait()

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.link.tell = lambda _: None
        if self._up.is_set():
            self._call(self._ended.set)
            self._thread.join()
        self._socket.close()
        self._loop.close()

    # -- the thread of the server -----------------------------------------------------------------------

    def _call(self, act: Callable[[], None]) -> None:
        self._loop.call_soon_threadsafe(act)

    async def _serve(self) -> None:
        self._ended = asyncio.Event()
        serving = serve(
            self._look_on,
            sock=self._socket,
            process_request=self._answer,
            max_size=MAX_MESSAGE_BYTES,
            compression=None,
            server_header=None,
            close_timeout=1,
        )
        async with serving as server:
            self._up.set()
            await self._ended.wait()
            await self._say_goodbye(server)

    async def _say_goodbye(self, server: SocketServer) -> None:
        """Send all waiting messages, then close the server."""
        for viewer in [*self._viewers]:
            viewer.waiting.append(_message(left=True))
        await asyncio.sleep(2 / MOMENTS_PER_S)
        server.close()

    def _answer(self, connection: ServerConnection, request: Request) -> Response | None:
        """Return the page, or the reason why the request is refused. The result None permits the browser to open the
        socket.
        """
        headers = request.headers
        refusal = self.access.refusal(request.path, headers.get_all("Host"), headers.get_all("Origin"))
        if refusal is not None:
            return _response(refusal.status, "text/plain", f"{refusal.sentence}\n".encode())
        if request.path.partition("?")[0] == LIVE:
            nothing = _response(HTTPStatus.NOT_FOUND, "text/plain", f"{NOTHING}\n".encode())
            return nothing if self._newest is None else None
        return _response(HTTPStatus.OK, "text/html", self._page)

    async def _look_on(self, connection: ServerConnection) -> None:
        """Serve one viewer until the page is closed."""
        assert self._newest is not None
        viewer = Viewer(connection)
        self._viewers.append(viewer)
        if self._driver is None:
            self._driver = viewer
        viewer.waiting.extend(self._told)
        self._tell_drive()
        feeding = asyncio.create_task(self._feed(viewer, self._newest))
        try:
            async for wish in connection:
                self._hear(viewer, wish)
        except ConnectionClosed:
            pass
        finally:
            feeding.cancel()
            self._viewers.remove(viewer)
            if self._driver is viewer:
                self._driver = None
            self._tell_drive()

    async def _feed(self, viewer: Viewer, newest: Newest) -> None:
        """Send the waiting messages, the newest state and the newest picture to a viewer, as fast as the viewer can
        receive them.
        """
        shown, pictured, heard = None, None, None
        try:
            while True:
                while viewer.waiting:
                    await viewer.connection.send(viewer.waiting.popleft())
                moment = newest.moment
                if moment is not shown:
                    await viewer.connection.send(moment.packed)
                    shown = moment
                television = newest.television
                if television is not pictured:
                    await viewer.connection.send(television.message)
                    pictured = television
                news = None if newest.live is None else newest.live.since(heard)
                if news is not None:
                    heard, message = news
                    await viewer.connection.send(message)
                await asyncio.sleep(1 / MOMENTS_PER_S)
        except ConnectionClosed:
            pass

    # -- telling and hearing ----------------------------------------------------------------------------

    def _tell(self, message: str) -> None:
        self._told.append(message)
        for viewer in self._viewers:
            self._send(viewer, message)

    def _send(self, viewer: Viewer, message: str) -> None:
        viewer.waiting.append(message)
        if len(viewer.waiting) > MAX_BEHIND:
            viewer.waiting.clear()
            viewer.connection.transport.abort()

    def _tell_drive(self) -> None:
        """Tell every viewer how many viewers there are, and who has control."""
        for viewer in self._viewers:
            free = self._driver is None
            self._send(viewer, _message(viewers=len(self._viewers), drives=self._driver is viewer, free=free))

    def _hear(self, viewer: Viewer, message: str | bytes) -> None:
        try:
            wish = _WISHES.decode(message)
        except (msgspec.DecodeError, UnicodeDecodeError):
            self._send(viewer, _message(refused="this message cannot be read"))
            return
        refused = self._carried_out(viewer, wish)
        if refused is not None:
            self._send(viewer, _message(refused=refused))

    def _carried_out(self, viewer: Viewer, wish: Wish) -> str | None:
        """Do what a viewer requests. Returns the reason if the request is refused, or None."""
        match wish:
            case Drive():
                self._driver = viewer
                self._tell_drive()
            case Panic():
                return None if self.link.press() else "nothing is moving: the panic button has no effect"
            case Say(line=line):
                if self._driver is not viewer:
                    return "another viewer has control: take control first"
                if not self.link.say(line):
                    return "too many lines are waiting: send this line again later"
        return None


def _taken(port: int) -> socket.socket:
    """Return a socket that accepts connections from this computer only."""
    taken = socket.socket(socket.AF_INET, socket.SOCK_STREAM)
    try:
        taken.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        taken.bind((HOST, port))
        taken.listen()
    except (OSError, OverflowError) as error:
        taken.close()
        why = error.strerror if isinstance(error, OSError) else "a port must be a number from 0 to 65535"
        raise Refused(f"port {port} is not available: {why}") from None
    return taken


def _message(**fields: object) -> str:
    return msgspec.json.encode(fields).decode()


def _response(status: HTTPStatus, kind: str, body: bytes) -> Response:
    headers = Headers(
        {
            "Content-Type": f"{kind}; charset=utf-8",
            "Content-Length": str(len(body)),
            "Cache-Control": "no-store",
            "Referrer-Policy": "no-referrer",
            "X-Content-Type-Options": "nosniff",
            "X-Frame-Options": "DENY",
            "Connection": "close",
        }
    )
    return Response(status.value, status.phrase, headers, body)
