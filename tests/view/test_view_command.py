"""`handeye view` of a run that was carried out: its report behind the same door, or one sentence."""

import http.client
import re
from pathlib import Path
from urllib.parse import urlsplit

import pytest
from conftest import Command

from handeye.cli import views
from handeye.runs.folder import PLAN, TRACE
from handeye.view.link import Link
from handeye.view.server import Server

ADDRESS = re.compile(r"http://127\.0\.0\.1:\d+/\?token=\S+")


def status(address: str) -> int:
    """What is answered to a request of an address by a page of this server."""
    asked = urlsplit(address)
    asking = http.client.HTTPConnection(asked.netloc, timeout=60)
    asking.request("GET", f"{asked.path}?{asked.query}", headers={"Origin": f"http://{asked.netloc}"})
    return asking.getresponse().status


def test_a_recorded_run_is_shown_until_ctrl_c(command: Command, monkeypatch: pytest.MonkeyPatch) -> None:
    shown: list[Server] = []
    seen: list[int] = []
    show = Server.show

    class Looking:
        """Somebody who looks until they press Ctrl-C."""

        def wait(self) -> None:
            address = shown[0].access.address
            seen.extend(map(status, (address, address.replace("/?", "/live?"), address.partition("?")[0])))
            raise KeyboardInterrupt

    monkeypatch.setattr(Server, "show", lambda self, page: (shown.append(self), show(self, page)))
    monkeypatch.setattr(views, "page_of", lambda run: f"the report of {run}".encode())
    monkeypatch.setattr(views, "Event", Looking)
    Path("kept").mkdir()
    code, out, _ = command("view", "kept")
    assert (code, seen) == (0, [200, 404, 403])
    assert ADDRESS.fullmatch(out.strip())


def test_a_folder_without_a_run_is_told_in_a_sentence(command: Command) -> None:
    Path("empty").mkdir()
    Path("begun").mkdir()
    Path("begun", PLAN).write_text("{}")
    Path("broken").mkdir()
    Path("broken", TRACE).write_bytes(b"\x89MCAP0\r\n and no more")
    told = {name: command("view", name) for name in ("empty", "begun", "broken", "none.mcap")}
    assert {code for code, *_ in told.values()} == {2}
    assert not any(out for _, out, _ in told.values())
    sentences = {name: err.splitlines()[-1] for name, (_, _, err) in told.items()}
    assert sentences["empty"] == "handeye: empty holds no run"
    assert sentences["begun"] == "handeye: the run in begun has not begun"
    assert sentences["none.mcap"] == "handeye: none.mcap: there is no such file"
    assert sentences["broken"].startswith("handeye: broken/trace.mcap is not a trace of handeye")


@pytest.mark.parametrize("option", [("--seed", "3"), ("--out", "x"), ("--fault", "jaw"), ("--camera", "ray")])
def test_options_of_a_run_do_not_go_with_one_that_was_carried_out(
    command: Command, option: tuple[str, str]
) -> None:
    Path("kept").mkdir()
    code, _, err = command("view", "kept", *option)
    assert (code, "it takes no option except --port" in err) == (2, True)


def test_the_demo_takes_no_plan(command: Command) -> None:
    code, _, err = command("view", "--demo", "kept")
    assert (code, "give either a plan or --demo" in err) == (2, True)


def test_a_port_in_use_is_told(command: Command) -> None:
    with Server(Link()) as other:
        code, _, err = command("view", "--demo", "--port", str(other.access.port))
    assert (code, "Address already in use" in err) == (2, True)
