"""The extension for VS Code: what its package holds, and what it makes of the server's answers."""

import importlib.util
import json
import shutil
import subprocess
import sys
import xml.etree.ElementTree as ET
from pathlib import Path
from types import ModuleType
from zipfile import ZipFile

import pytest

FOLDER = Path(__file__).parents[2] / "editors" / "vscode"
SCRIPT = """\
        STAGE   "look"
        PARK
        JUMP    L1
L1:     MOVE    HOLE
"""
TAUGHT = """\
[positions]
PARK = { at = [20.0, 28.0, 8.0, 90, 90, 0] }
HOLE = { at = [25.0, 38.0, 4.0, 90, 90, 0] }
"""


@pytest.fixture
def maker() -> ModuleType:
    spec = importlib.util.spec_from_file_location("make_vsix", FOLDER / "make_vsix.py")
    assert spec is not None
    assert spec.loader is not None
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def named(about: object) -> set[str]:
    """Every file that a manifest names: `./` and a path."""
    if isinstance(about, dict):
        return set().union(*map(named, about.values()))
    if isinstance(about, list):
        return set().union(*map(named, about))
    return {about[2:]} if isinstance(about, str) and about.startswith("./") else set()


def test_the_package_holds_what_its_manifests_name(maker: ModuleType, tmp_path: Path) -> None:
    for name in ("one.vsix", "other.vsix"):
        maker.packed(tmp_path / name)
    assert (tmp_path / "one.vsix").read_bytes() == (tmp_path / "other.vsix").read_bytes()
    with ZipFile(tmp_path / "one.vsix") as package:
        held = set(package.namelist())
        about = json.loads(package.read("extension/package.json"))
        manifest = ET.fromstring(package.read("extension.vsixmanifest"))  # noqa: S314 - it is ours
        types = ET.fromstring(package.read("[Content_Types].xml"))  # noqa: S314
        code = package.read("extension/extension.js").decode()
    assert {f"extension/{name}" for name in named(about)} <= held
    assert {each.get("Path") for each in manifest.iter() if each.tag.endswith("Asset")} <= held
    (identity,) = (each for each in manifest.iter() if each.tag.endswith("Identity"))
    assert (identity.get("Id"), identity.get("Version")) == (about["name"], about["version"])
    assert {Path(name).suffix[1:] for name in held if name != "[Content_Types].xml"} <= {
        each.get("Extension") for each in types
    }
    assert "extension/client.js" in held
    assert 'require("./client")' in code
    assert "dependencies" not in about  # nothing is to be fetched


@pytest.mark.slow
@pytest.mark.skipif(shutil.which("node") is None, reason="node is not installed")
def test_the_extension_asks_the_server_and_runs_a_stage(tmp_path: Path) -> None:
    script = tmp_path / "a.al"
    script.write_text(SCRIPT, encoding="utf-8")
    (tmp_path / "a.toml").write_text(TAUGHT, encoding="utf-8")
    program = tmp_path / "handeye"
    program.write_text(f'#!/bin/sh\nexec {sys.executable} -m handeye "$@"\n', encoding="utf-8")
    program.chmod(0o755)
    words = ["node", str(Path(__file__).with_name("fake_editor.js")), str(script), str(program)]
    done = subprocess.run(
        [*words, str(FOLDER / "extension.js")], capture_output=True, timeout=60, check=False
    )
    assert done.returncode == 0, done.stderr
    told = json.loads(done.stdout)
    assert "position `HOLE`" in json.dumps(told["hover"])
    assert [item["given"][0] for item in told["completion"]] == ["HOLE", "PARK"]
    assert [place["given"][0] for place in told["definition"]] == ["a.toml"]
    assert [place["given"][0] for place in told["references"]] == ["a.al", "a.toml"]
    assert sorted(told["renamed"]) == ["a.al", "a.toml"]
    assert told["formatted"] == []
    assert told["symbols"][0]["given"][:2] == ["look", "stage"]
    assert told["lenses"] == ["Run", "Run from here", "Debug"]
    assert told["task"] == [
        str(program),
        ["run", str(script), "--step", "--from", "1"],
        {"cwd": str(tmp_path)},
    ]
    assert [each["code"] for each in told["diagnostics"]] == ["unknown-position"]
    assert [fix["given"][0] for fix in told["fixes"]] == ["change to `HOLE`"]
    words[-1] = str(tmp_path / "absent")
    done = subprocess.run(
        [*words, str(FOLDER / "extension.js")], capture_output=True, timeout=60, check=False
    )
    assert "The arm language server did not start" in json.loads(done.stdout)["error"]
