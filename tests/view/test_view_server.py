"""The server as pages meet it, by the counter machine, in one process and without a browser."""

import http.client
import json
import socket
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from threading import Event, Thread
from typing import Any

import numpy as np
import pytest
from toy_system import begin_toy
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import ClientConnection, connect

from handeye.core.errors import InvalidInput
from handeye.debugger.stepper import Stepper
from handeye.report.facts.seen import SeenPicture
from handeye.runs.runner import Runner
from handeye.view.link import Link
from handeye.view.moment import Newest, Television
from handeye.view.server import MAX_BEHIND, MAX_MESSAGE_BYTES, Server
from handeye.view.stepping import drive

PAGE = b"<!DOCTYPE html>the page"
PICTURE = SeenPicture(
    time=1.0, name="NEAR", lens=0.05, picture=np.zeros((3, 4), dtype=np.uint8), marks=(), findings=()
)


class Theatre:
    """A run of the counter machine, served."""

    def __init__(self, open_: ExitStack) -> None:
        self.open = open_
        runner = Runner(begin_toy())
        self.stepper = Stepper(runner)
        self.server = open_.enter_context(Server(Link()))
        self.newest = Newest(runner)
        self.server.show(PAGE, self.newest)

    @property
    def port(self) -> int:
        return self.server.access.port

    def way(self, **more: Any) -> dict[str, Any]:
        """How a page of this server opens its socket."""
        target = f"ws://127.0.0.1:{self.port}/live?token={self.server.access.token}"
        own = {"uri": target, "origin": f"http://127.0.0.1:{self.port}", "proxy": None, "open_timeout": 60}
        return own | {"close_timeout": 1} | more  # whoever has not read all is not waited for

    def viewer(self, **more: Any) -> ClientConnection:
        """Somebody who looks on, told of the drive."""
        viewer = self.open.enter_context(connect(**self.way(**more)))
        heard(viewer, "viewers")
        return viewer

    def go(self, *lines: str) -> None:
        """Carry out lines, each when the run pauses, and leave the run."""
        rest = iter((*lines, "quit"))

        @contextmanager
        def asked() -> Iterator[None]:
            self.server.link.say(next(rest))
            yield

        drive(self.stepper, self.server.link, asked)

    def get(self, target: str, **headers: str) -> http.client.HTTPResponse:
        asking = http.client.HTTPConnection("127.0.0.1", self.port, timeout=60)
        asking.request("GET", target, headers=headers)
        return asking.getresponse()


@pytest.fixture
def theatre() -> Iterator[Theatre]:
    with ExitStack() as open_:
        yield Theatre(open_)


def say(viewer: ClientConnection, **wish: str) -> None:
    viewer.send(json.dumps(wish))


def heard(viewer: ClientConnection, name: str) -> dict[str, Any]:
    """The next message that has a field; moments and others are passed over."""
    while True:
        message = viewer.recv(timeout=60)
        if isinstance(message, str) and name in (told := json.loads(message)):
            return dict(told)


# -- who is let through ---------------------------------------------------------------------------------


def test_the_page_is_there_for_whoever_has_its_address(theatre: Theatre) -> None:
    answer = theatre.get(f"/?token={theatre.server.access.token}")
    assert (answer.status, answer.read()) == (200, PAGE)
    assert answer.getheader("Cache-Control") == "no-store"
    assert answer.getheader("Access-Control-Allow-Origin") is None


def test_what_is_refused_is_told_in_a_sentence_and_gives_nothing_away(theatre: Theatre) -> None:
    token = theatre.server.access.token
    told = [
        theatre.get("/"),
        theatre.get(f"/?token={token}", Host="evil.example"),
        theatre.get(f"/../x?token={token}"),
    ]
    assert [answer.status for answer in told] == [403, 403, 404]
    said = [answer.read().decode() for answer in told]
    assert said[0] == "the token is missing or wrong: open the address that handeye printed\n"
    assert not any(token in each for each in said)


@pytest.mark.parametrize("origin", ["http://evil.example", "null", None])
def test_a_socket_from_another_page_is_refused(theatre: Theatre, origin: str | None) -> None:
    with pytest.raises(InvalidStatus, match="403"):
        theatre.viewer(origin=origin)


def test_a_socket_without_the_token_is_refused(theatre: Theatre) -> None:
    with pytest.raises(InvalidStatus, match="403"):
        theatre.viewer(uri=f"ws://127.0.0.1:{theatre.port}/live")


def test_it_listens_on_this_computer_alone(theatre: Theatre) -> None:
    assert theatre.server._socket.getsockname()[0] == "127.0.0.1"


def test_a_port_in_use_is_told_at_once(theatre: Theatre) -> None:
    with pytest.raises(
        InvalidInput, match=rf"^port {theatre.port} is not available: Address already in use$"
    ):
        Server(Link(), theatre.port)


@pytest.mark.parametrize("port", [-1, 70000])
def test_a_port_that_cannot_be_is_told(port: int) -> None:
    with pytest.raises(
        InvalidInput, match=rf"^port {port} is not available: a port must be a number from 0 to 65535$"
    ):
        Server(Link(), port)


# -- looking on and driving -----------------------------------------------------------------------------


def test_everybody_is_told_what_was_said_and_what_came_of_it(theatre: Theatre) -> None:
    viewers = [theatre.viewer() for _ in range(3)]
    theatre.go("step 2")
    for viewer in viewers:
        assert heard(viewer, "reply")["reply"]["command"] == ""
        assert [heard(viewer, "under_way")["under_way"]["line"] for _ in range(2)] == [1, 2]
        told = heard(viewer, "reply")
        assert (told["reply"]["command"], told["reply"]["position"]) == ("step 2", 2)
        assert "2 steps done" in told["shown"]


def test_what_whoever_drives_says_reaches_the_run(theatre: Theatre) -> None:
    driver = theatre.viewer()
    say(driver, do="say", line="step 3")
    say(driver, do="drive")
    heard(driver, "drives")  # what was said before has come
    assert theatre.server.link.come() == "step 3"


def test_one_drives_and_the_drive_can_be_taken_over(theatre: Theatre) -> None:
    first, second = theatre.viewer(), theatre.viewer()
    say(second, do="say", line="step")
    assert heard(second, "refused")["refused"] == "another viewer has control: take control first"
    say(second, do="drive")
    assert heard(second, "viewers") == {"viewers": 2, "drives": True, "free": False}
    say(first, do="say", line="step")
    assert heard(first, "refused")["refused"] == "another viewer has control: take control first"


def test_a_drive_is_free_when_whoever_had_it_has_gone(theatre: Theatre) -> None:
    first, second = theatre.viewer(), theatre.viewer()
    first.close()
    assert heard(second, "viewers") == {"viewers": 1, "drives": False, "free": True}


def test_who_comes_later_is_told_what_has_been_told(theatre: Theatre) -> None:
    theatre.go("step 3")
    viewer = theatre.open.enter_context(connect(**theatre.way()))
    assert [heard(viewer, "reply")["reply"]["position"] for _ in range(3)] == [0, 3, 3]


def test_everybody_is_shown_the_picture_that_was_taken_last(theatre: Theatre) -> None:
    viewer = theatre.viewer()
    assert heard(viewer, "television") == {"television": ""}
    theatre.newest.television = Television(PICTURE)
    for looking in (viewer, theatre.viewer()):
        assert "<b>NEAR</b>" in heard(looking, "television")["television"]


def test_when_the_run_has_been_left_everybody_is_told() -> None:
    with ExitStack() as viewers:
        with ExitStack() as open_:
            theatre = Theatre(open_)
            viewer = viewers.enter_context(connect(**theatre.way()))
            heard(viewer, "viewers")
            theatre.go()
        assert heard(viewer, "left") == {"left": True}
        with pytest.raises(ConnectionClosed):
            heard(viewer, "never")


def test_nothing_goes_that_panic_could_stop(theatre: Theatre) -> None:
    viewer = theatre.viewer()
    say(viewer, do="panic")
    assert heard(viewer, "refused")["refused"] == "nothing is moving: the panic button has no effect"


# -- the run does not wait ------------------------------------------------------------------------------


def test_the_run_goes_on_while_nothing_can_be_sent(theatre: Theatre) -> None:
    theatre.viewer()
    held, on = Event(), Event()

    def hold() -> None:
        """Keep the thread of the server from doing anything else."""
        held.set()
        on.wait(60)

    theatre.server._call(hold)
    assert held.wait(60)
    running = Thread(target=theatre.go, args=("step 2", "continue"))
    running.start()
    running.join(30)
    gone_on = not running.is_alive()
    on.set()
    running.join()
    assert gone_on


def test_whoever_takes_in_too_little_is_let_go(theatre: Theatre) -> None:
    viewer = theatre.viewer()

    def tell_much() -> None:
        """Tell more, at once, than anybody could take in."""
        for _ in range(MAX_BEHIND + 1):
            theatre.server._tell("{}")

    theatre.server._call(tell_much)
    with pytest.raises(ConnectionClosed):
        heard(viewer, "never")
    assert theatre.viewer()


# -- what nobody should send ----------------------------------------------------------------------------


@pytest.mark.parametrize(
    "message",
    ["", "{", "[]", '{"do": "fly"}', '{"do": "say"}', '{"do": "say", "line": 3}', '{"do": "panic", "more": 1}',
     json.dumps({"do": "say", "line": "x" * 1001}), b"\xff\xfe", '{"do": "say", "line": "\\ud800"}'],
)  # fmt: skip
def test_what_cannot_be_understood_is_refused_and_changes_nothing(
    theatre: Theatre, message: str | bytes
) -> None:
    viewer = theatre.viewer()
    viewer.send(message)
    assert heard(viewer, "refused")["refused"] == "this message cannot be read"
    assert theatre.server.link.come() is None


def test_a_message_that_is_too_large_ends_its_connection_and_no_other(theatre: Theatre) -> None:
    viewer, other = theatre.viewer(), theatre.viewer()
    viewer.send("x" * (MAX_MESSAGE_BYTES + 1))
    with pytest.raises(ConnectionClosed, match="1009"):
        heard(viewer, "never")
    say(other, do="drive")
    assert heard(other, "drives")


def test_a_flood_of_lines_is_answered_line_by_line_and_fills_nothing(theatre: Theatre) -> None:
    viewer = theatre.viewer()
    for _ in range(150):
        say(viewer, do="say", line="step")
    assert heard(viewer, "refused")["refused"] == "too many lines are waiting: send this line again later"


def test_rubbish_in_the_place_of_a_request_is_survived(theatre: Theatre) -> None:
    with socket.create_connection(("127.0.0.1", theatre.port), timeout=60) as raw:
        raw.sendall(b"\x16\x03\x01 POST / nonsense\r\n\r\n")
        raw.recv(4096)
    assert theatre.get(f"/?token={theatre.server.access.token}").status == 200
