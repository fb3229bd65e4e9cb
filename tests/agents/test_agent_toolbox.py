"""What the tools of an agent do, without a protocol."""

import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any

import pytest
from conftest import Command

from handeye.agents.agent_folder import AgentFolder
from handeye.agents.call import Call
from handeye.agents.open_runs import MOST_OPEN
from handeye.agents.replies import Reply
from handeye.agents.toolbox import Toolbox
from handeye.agents.tools import tool_named, used

pytestmark = pytest.mark.slow
EMPTY_HAND = "OPEN 1\nCLOSE .5\nOPEN 2\n"
FORGETFUL = "OPEN 1\nOPEN 2\n"  # reports success without having moved the pin
ENDLESS = "L: SAVE A\nJUMP L\n"
PIN: dict[str, Any] = {"task": "insertion"}


class Agent:
    """Uses tools."""

    def __init__(self, folder: Path) -> None:
        self.toolbox = Toolbox(AgentFolder.at(folder))

    def __call__(self, tool: str, call: Call | None = None, /, **arguments: object) -> Reply:
        return used(tool_named(tool), self.toolbox, arguments, call or Call())


@pytest.fixture
def agent(tmp_path: Path) -> Iterator[Agent]:
    found = Agent(tmp_path)
    yield found
    found.toolbox.close()


def test_a_world_lists_spreads_and_sources_and_no_values(agent: Agent) -> None:
    reply = agent("world", task="insertion", group="plate")
    assert reply.data is not None
    assert [row["name"] for row in reply.data["quantities"]] == ["plate.x", "plate.y"]
    assert {key for row in reply.data["quantities"] for key in row} == {
        "name", "unit", "nominal", "distribution", "spread", "source",
    }  # fmt: skip
    assert reply.text.startswith("plate.x: sigma 1 mm. Position of the hole")


def test_the_tools_show_included_scripts(agent: Agent) -> None:
    assert 'STAGE   "insert it"' in agent("docs", topic="insertion.al").text
    assert agent("docs", topic="search").text.startswith("# `SEARCH step")
    assert agent("explain", word="FLY").failed
    assert not agent("explain", word="DELAY").failed  # of another language


def test_other_languages_are_checked_and_not_run(agent: Agent) -> None:
    reply = agent("check", script="10 NIX\n", language="ml")
    assert (reply.failed, reply.data and reply.data["ok"]) == (False, False)
    (agent.toolbox.folder.root / "a.mal").write_text("END\n")
    assert agent("plan", script="a.mal").failed


def test_a_call_to_the_operator_can_be_answered(agent: Agent) -> None:
    called = agent("run", script=EMPTY_HAND, **PIN)
    assert called.text.endswith("`run` continues this run if you give an `answer`: retry, proceed or skip")
    assert agent("result").text.startswith("run run-1: stopped; the program stopped and called the operator")
    ended = agent("run", answer="proceed")
    assert ended.data is not None
    assert ended.data["why"] == "the program finished"


def test_a_false_report_of_success_is_a_silent_failure(agent: Agent) -> None:
    reply = agent("submit", script=FORGETFUL, worlds=1, **PIN)
    assert reply.data is not None
    assert (reply.data["silent"], reply.data["accepted"], reply.data["stopped"]) == (1, 0, 0)
    assert "height of the pin's shoulder" in reply.text


def test_a_program_without_an_end_is_stopped(agent: Agent, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr("handeye.agents.judging.MOST_STEPS", 100)
    reply = agent("submit", script=ENDLESS, worlds=1, **PIN)
    assert reply.data is not None
    assert reply.data["stopped"] == 1
    assert "the program was still running after 200 steps" in reply.text


def test_a_program_without_an_end_can_be_cancelled(agent: Agent) -> None:
    call = Call()
    assert agent("run", script=ENDLESS, steps=0, **PIN).data is not None
    call.cancelled.set()
    assert agent("run", call).text.endswith("paused on request")
    assert agent("submit", call, script=ENDLESS, worlds=1, **PIN).failed


def test_runs_that_were_closed_to_save_memory_go_on(agent: Agent) -> None:
    for _ in range(MOST_OPEN + 1):
        agent("run", script="OPEN 1\nOPEN 2\n", steps=1, **PIN)
    assert agent("state", run="run-1", show="gap").text.startswith("run run-1\n")
    assert agent("run", run="run-1").text.endswith("the program finished")
    agent.toolbox.close()
    assert agent("state", run="run-1").text.startswith("the run run-1 ended earlier and is closed")
    assert agent("result", run="run-1").text.startswith("run run-1: silent")


def test_a_name_is_given_to_one_run_only(agent: Agent) -> None:
    agent("run", script="OPEN 1\n", run="a", steps=0, **PIN)
    assert (
        agent("run", script="OPEN 1\n", run="a", **PIN).text
        == "there is already a run a; choose another name"
    )
    assert agent("fork", to="a").text == "there is already a run a; choose another name"


def test_without_the_package_the_command_names_the_extra(
    command: Command, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setitem(sys.modules, "mcp", None)
    monkeypatch.delitem(sys.modules, "handeye.agents.server", raising=False)
    code, out, err = command("mcp", "--folder", "agent")
    assert (code, out) == (2, "")
    assert "`mcp` needs mcp, which is not installed" in err
    assert not Path("agent").exists()
