"""The server of an agent, used over standard input and output by the client of the protocol's own Python SDK."""

from __future__ import annotations

import sys
from dataclasses import dataclass, field
from pathlib import Path
from typing import TYPE_CHECKING, Any

import anyio
import pytest

import handeye
from handeye.agents.tools import TOOLS

if TYPE_CHECKING:
    from mcp import Client
    from mcp.types import CallToolResult

pytestmark = pytest.mark.slow


@dataclass
class Session:
    """What an agent saw of a pin task, from the first look at the tools until it left."""

    folder: Path
    tools: dict[str, Any] = field(default_factory=dict)
    replies: dict[str, CallToolResult] = field(default_factory=dict)
    progress: dict[str, list[str]] = field(default_factory=dict)

    def text(self, name: str) -> str:
        return self.replies[name].content[0].text  # type: ignore[union-attr]

    def data(self, name: str) -> dict[str, Any]:
        found = self.replies[name].structured_content
        assert found is not None
        return found


@pytest.fixture(scope="module")
def session(tmp_path_factory: pytest.TempPathFactory) -> Session:
    found = Session(tmp_path_factory.mktemp("agent"))
    anyio.run(pin_task, found)
    return found


async def pin_task(found: Session) -> None:
    """A pin is put into its hole. Then the agent continues a fork of the run, and leaves when it hears of progress."""
    with anyio.CancelScope() as staying:
        async with connected(found.folder) as client:
            found.tools = {tool.name: tool for tool in (await client.list_tools()).tools}

            async def call(name: str, tool: str, **arguments: object) -> None:
                async def heard(_: float, __: float | None, text: str | None) -> None:
                    found.progress.setdefault(name, []).append(text or "")

                found.replies[name] = await client.call_tool(tool, arguments, progress_callback=heard)

            await call("check", "check", script="insertion")
            await call("begun", "run", script="insertion", seed=3, until="insert it")
            await call("too soon", "result")
            await call("forked", "fork", stage="insert it", to="second")
            with anyio.CancelScope() as continuing:
                await broken_off(client, continuing)
            await call("broken off", "state", show="hand")
            await call("ended", "run", run="run-1")
            await call("verdict", "result")
            await call("back", "back", steps=2)
            await call("no picture", "picture")
            await call("no tool", "fly")
            await broken_off(client, staying)


def connected(folder: Path) -> Client:
    from mcp import Client, StdioServerParameters, stdio_client  # only where it is used: it takes seconds

    words = ["-m", "handeye", "mcp", "--folder", str(folder)]
    return Client(stdio_client(StdioServerParameters(command=sys.executable, args=words)))


async def broken_off(client: Client, scope: anyio.CancelScope) -> None:
    """Continue the second run, and leave `scope` when the first report comes."""

    async def heard(_: float, __: float | None, ___: str | None) -> None:
        scope.cancel()

    await client.call_tool("run", {"run": "second"}, progress_callback=heard)


def test_tools_say_which_of_them_change_a_run(session: Session) -> None:
    assert [*session.tools] == [tool.name for tool in TOOLS]
    hints = {name: tool.annotations for name, tool in session.tools.items()}
    assert {name for name, hint in hints.items() if not hint.read_only_hint} == {"run", "back", "fork"}
    assert {name for name, hint in hints.items() if hint.destructive_hint} == {"back"}
    assert not any(hint.open_world_hint for hint in hints.values())


def test_a_tool_shows_what_it_takes(session: Session) -> None:
    schema = session.tools["submit"].input_schema
    assert (schema["type"], schema["required"], schema["additionalProperties"]) == (
        "object",
        ["script"],
        False,
    )


def test_a_pin_is_put_into_its_hole(session: Session) -> None:
    assert session.text("check") == "insertion.al: no errors"
    assert session.data("begun")["position"] == 6
    assert session.data("begun")["why"] == "breakpoint at stage 2, insert it"
    assert session.data("ended")["why"] == "the program finished"
    assert session.data("verdict")["outcome"] == "accepted"
    assert session.data("verdict")["referee"]["seat"]["ok"]


def test_a_long_call_reports_where_it_is(session: Session) -> None:
    assert session.progress["begun"][0] == "preparing the cell"
    assert session.progress["begun"][-1].endswith("fetch the pin, line 13: MOVE HOLE")


def test_the_referee_judges_no_run_that_has_not_ended(session: Session) -> None:
    assert session.replies["too soon"].is_error
    assert session.text("too soon").startswith(
        "the run run-1 has not ended, so the referee has not judged it"
    )


def test_a_fork_begins_where_the_stage_begins(session: Session) -> None:
    assert (session.data("forked")["run"], session.data("forked")["position"]) == ("second", 6)


def test_a_cancelled_call_pauses_its_run(session: Session) -> None:
    where = session.data("broken off")
    assert 6 <= where["position"] < session.data("ended")["position"]
    assert not where["ended"]


def test_a_run_goes_back(session: Session) -> None:
    assert session.data("back")["position"] == session.data("ended")["position"] - 2


def test_without_a_camera_there_is_no_picture(session: Session) -> None:
    assert session.replies["no picture"].is_error
    assert session.text("no picture") == "the program of the run run-1 has taken no picture yet"


def test_an_unknown_tool_is_an_error_of_the_tool(session: Session) -> None:
    assert session.replies["no tool"].is_error
    assert session.text("no tool").startswith("there is no tool `fly`; the tools are docs, check")


def test_an_agent_that_leaves_leaves_a_run_that_can_be_resumed(session: Session) -> None:
    folder = session.folder / "runs/second"
    assert handeye.begin(folder).state.position >= 6
    with handeye.begin(folder, out=folder) as run:
        assert run.until().why == "the program finished"
    assert run.assembled
