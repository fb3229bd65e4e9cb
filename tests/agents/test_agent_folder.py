"""The folder of an agent: its calls read and write nothing outside it."""

from pathlib import Path

import pytest

from handeye.agents.agent_folder import AgentFolder
from handeye.agents.call import Call
from handeye.agents.toolbox import Toolbox
from handeye.agents.tools import tool_named, used
from handeye.core.errors import BadArgument, CannotWrite

FOREIGN = "OPEN 4321\n"


@pytest.fixture
def toolbox(tmp_path: Path) -> Toolbox:
    """The tools of an agent, beside whose folder lies a file that is not the agent's."""
    (tmp_path / "secret.al").write_text(FOREIGN)
    own = tmp_path / "own"
    own.mkdir()
    (own / "link.al").symlink_to(tmp_path / "secret.al")
    (own / "up").symlink_to(tmp_path)
    return Toolbox(AgentFolder.at(own))


OUTSIDE = [
    "../secret.al", "own/../../secret.al", "./../secret.al", "link.al", "up/secret.al", "~/secret.al", ".", "..", "",
    "a//b", "/etc/passwd", "..\\secret.al", "C:\\secret.al", "secret.al\x00", "%2e%2e/secret.al", "a" * 300, "b/" * 20,
]  # fmt: skip


@pytest.mark.parametrize("name", OUTSIDE)
def test_a_name_that_leads_out_of_the_folder_is_refused(toolbox: Toolbox, name: str) -> None:
    with pytest.raises(BadArgument, match=r"is not a file in the agent's folder|link, which is not followed"):
        toolbox.folder.source(name)


@pytest.mark.parametrize("name", ["../run", "run/1", "", ".hidden", "a" * 41, "run\n"])
def test_a_run_has_no_name_that_leads_out_of_the_folder(toolbox: Toolbox, name: str) -> None:
    with pytest.raises(BadArgument, match="a run cannot be called"):
        toolbox.folder.run(name)


@pytest.mark.parametrize("place", ["../secret.al", "link.al", "up/secret.al"])
@pytest.mark.parametrize("argument", ["script", "taught", "required"])
def test_no_tool_shows_a_text_from_outside(
    toolbox: Toolbox, tmp_path: Path, argument: str, place: str
) -> None:
    given = {
        "script": {"script": place},
        "taught": {"script": "OPEN 1\n", "taught": place},
        "required": {"script": f'REQUIRE "{place}"\nOPEN 1\n'},
    }[argument]
    for tool in ("check", "plan", "run", "submit"):
        reply = used(tool_named(tool), toolbox, given, Call())
        assert "4321" not in reply.text
        assert str(tmp_path) not in reply.text
        assert (
            "is not a file in the agent's folder" in reply.text or "link, which is not followed" in reply.text
        )
    assert toolbox.folder.runs() == []


def test_a_script_requires_files_beside_it(toolbox: Toolbox) -> None:
    (toolbox.folder.root / "tries").mkdir()
    (toolbox.folder.root / "tries/open.al").write_text("OPEN 1\n")
    (toolbox.folder.root / "tries/pin.al").write_text('REQUIRE "open.al"\nOPEN 2\n')
    reply = used(tool_named("plan"), toolbox, {"script": "tries/pin.al"}, Call())
    assert "2 steps" in reply.text


def test_a_run_whose_folder_holds_a_link_is_not_opened(toolbox: Toolbox, tmp_path: Path) -> None:
    (toolbox.folder.root / "runs/a").mkdir(parents=True)
    (toolbox.folder.root / "runs/a/plan.json").symlink_to(tmp_path / "secret.al")
    for tool in ("state", "result", "fork", "run"):
        reply = used(tool_named(tool), toolbox, {"run": "a"}, Call())
        assert (reply.failed, reply.text) == (
            True,
            "the folder of the run a holds a link, which is not followed",
        )


def test_without_a_folder_a_new_one_is_made(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(tmp_path)
    made = [AgentFolder.at(None).root.name for _ in range(2)]
    assert made == ["handeye-agent", "handeye-agent-2"]


def test_a_file_is_no_folder(tmp_path: Path) -> None:
    (tmp_path / "file").write_text("")
    with pytest.raises(CannotWrite, match=r"the folder .*file cannot be created: File exists"):
        AgentFolder.at(tmp_path / "file")
