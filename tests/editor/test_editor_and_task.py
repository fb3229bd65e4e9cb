"""An editor checks a script as the commands do: for the arm and the fixtures of the task."""

from dataclasses import replace
from pathlib import Path

import pytest
from documents import document, pointed
from lsprotocol import types as lsp
from pygls.workspace import Workspace

from handeye.arm.robots.stanford import STANFORD
from handeye.editor.checking import planning
from handeye.editor.hover import hover
from handeye.editor.samples import SAMPLE
from handeye.editor.script import EditedScript
from handeye.runs.scripts import taught
from handeye.tasks import task


@pytest.fixture
def short_boom(monkeypatch: pytest.MonkeyPatch) -> None:
    """The task has an arm whose boom is 15 in long at most."""
    boom = replace(STANFORD.joints[2], name="short boom", upper=15 * 0.0254)
    arm = replace(STANFORD, name="short", joints=(*STANFORD.joints[:2], boom, *STANFORD.joints[3:]))
    monkeypatch.setattr(type(task()), "arm", arm)


@pytest.mark.usefixtures("short_boom")
def test_a_script_is_planned_for_the_arm_of_the_task() -> None:
    program, _ = document("MOVE P").compiled
    assert program is not None
    assert {("the short arm" in found.message) for found in planning(program)} == {True}


@pytest.mark.usefixtures("short_boom")
def test_a_position_is_told_in_the_joints_of_the_arm_of_the_task() -> None:
    told = hover(*pointed("MOVE |P"))
    assert told is not None
    assert "joint 3 (short boom) would have to be" in told.text


def test_motions_are_kept_clear_of_the_fixtures_of_the_task(
    monkeypatch: pytest.MonkeyPatch, tmp_path: Path
) -> None:
    script = tmp_path / "a.al"
    script.write_text("PARK\n", encoding="utf-8")
    monkeypatch.setattr(type(task()), "fixtures", lambda _: SAMPLE.fixtures)
    workspace = Workspace(None)
    workspace.put_text_document(lsp.TextDocumentItem(script.as_uri(), "armal", 1, "PARK\n"))
    known = EditedScript(workspace, script.as_uri()).document.taught
    assert known == taught(script)
    assert known.fixtures == SAMPLE.fixtures
