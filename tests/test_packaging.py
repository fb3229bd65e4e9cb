"""What pyproject.toml says of the package is so, and the locks hold what it asks for."""

import os
import re
import runpy
import shutil
import subprocess
import sys
import tarfile
import tomllib
from importlib.metadata import EntryPoint
from pathlib import Path
from typing import Any

import pytest
from hatchling.builders.sdist import SdistBuilder
from hatchling.builders.wheel import WheelBuilder
from hatchling.metadata.plugin.interface import MetadataHookInterface
from hatchling.plugin.utils import load_plugin_from_script
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from handeye.core.versions import HANDEYE

ROOT = Path(__file__).parent.parent
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = PYPROJECT["project"]
DEPENDENCIES = [Requirement(text) for text in PROJECT["dependencies"]]
BUILDING = [Requirement(text) for text in PYPROJECT["dependency-groups"]["build"]]
TESTING = [Requirement(text) for text in PYPROJECT["dependency-groups"]["dev"]]


def locked(name: str) -> set[tuple[str, str]]:
    """Names and versions in a lock; two versions where an older Python needs the older one."""
    text = (ROOT / name).read_text(encoding="utf-8")
    assert "://" not in text  # a lock names packages and hashes, and no place to fetch them from
    return set(re.findall(r"^([\w.-]+)==([^\s;]+)", text, re.MULTILINE))


def test_the_package_has_the_version_that_results_name() -> None:
    assert PROJECT["version"] == HANDEYE


def test_the_lock_of_the_tests_holds_all_of_the_other() -> None:
    assert locked("requirements.lock") - locked("requirements-dev.lock") == set()


@pytest.mark.parametrize(
    ("wanted", "lock"),
    [
        *((wanted, "requirements.lock") for wanted in DEPENDENCIES + BUILDING),
        *((wanted, "requirements-dev.lock") for wanted in TESTING),
    ],
    ids=str,
)
def test_every_requirement_is_locked_at_versions_it_allows(wanted: Requirement, lock: str) -> None:
    versions = [version for name, version in locked(lock) if name == canonicalize_name(wanted.name)]
    assert versions
    assert all(wanted.specifier.contains(version) for version in versions)


def test_the_package_is_built_with_what_is_locked() -> None:
    assert set(PYPROJECT["build-system"]["requires"]) <= set(map(str, BUILDING))


@pytest.mark.parametrize(
    ("group", "name"),
    [("console_scripts", "handeye"), ("pygments.lexers", "armal")],
)
def test_every_entry_point_leads_somewhere(group: str, name: str) -> None:
    points = {"console_scripts": PROJECT["scripts"], **PROJECT["entry-points"]}
    assert EntryPoint(name=name, group=group, value=points[group][name]).load() is not None


def test_the_package_says_that_it_is_typed() -> None:
    assert (ROOT / "handeye" / "py.typed").exists()
    assert "Typing :: Typed" in PROJECT["classifiers"]


@pytest.fixture(scope="module")
def installed(tmp_path_factory: pytest.TempPathFactory) -> Path:
    """A wheel that was built out of a source distribution, unpacked."""
    place = tmp_path_factory.mktemp("built")
    (sdist,) = SdistBuilder(str(ROOT)).build(directory=str(place))
    with tarfile.open(sdist) as archive:
        archive.extractall(place, filter="data")
    unpacked = place / f"handeye-{PROJECT['version']}"
    (wheel,) = WheelBuilder(str(unpacked)).build(directory=str(place), versions=["standard"])
    shutil.unpack_archive(wheel, place / "wheel", "zip")
    return place / "wheel"


@pytest.mark.slow
def test_a_wheel_out_of_the_source_distribution_holds_all_data(installed: Path) -> None:
    def files(folder: Path) -> set[str]:
        return {path.relative_to(folder).as_posix() for path in folder.rglob("*.*") if path.suffix != ".pyc"}

    data = PYPROJECT["tool"]["hatch"]["build"]["targets"]["wheel"]["force-include"]
    for name, place in data.items():
        assert files(installed / place) == files(ROOT / name)
    assert files(installed / "handeye") >= files(ROOT / "handeye")
    pages = {page.relative_to(ROOT).as_posix() for page in (ROOT / "docs").rglob("*.md")}
    assert {
        f"docs/{name}" for name in files(installed / "handeye/_data/docs") if name.endswith(".md")
    } == pages


def typed(installed: Path, place: Path, *words: str) -> tuple[int, str]:
    """Exit code and output of a command of the wheel, in an empty folder without a display."""
    hidden = ("DISPLAY", "WAYLAND_DISPLAY", "BROWSER")
    kept = {name: value for name, value in os.environ.items() if name not in hidden}
    done = subprocess.run(
        [sys.executable, "-m", "handeye", *words],
        cwd=place,
        env={**kept, "PYTHONPATH": str(installed), "PYTHONSAFEPATH": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    return done.returncode, done.stdout


@pytest.mark.slow
def test_a_wheel_out_of_the_source_distribution_runs_in_an_empty_folder(
    installed: Path, tmp_path: Path
) -> None:
    data = f"{installed}/handeye/_data"
    assert typed(installed, tmp_path, "check", "water_pump") == (
        0,
        f"{data}/plans/water_pump.al: no errors\n",
    )
    assert typed(installed, tmp_path, "demo") == (0, "demo.html\n")
    assert "The pump is assembled." in (tmp_path / "demo.html").read_text(encoding="utf-8")


@pytest.mark.slow
def test_a_wheel_explains_with_pages_that_are_there(installed: Path, tmp_path: Path) -> None:
    code, said = typed(installed, tmp_path, "explain", "SEARCH")
    page = Path(said.rstrip().rpartition("More and examples: ")[2])
    assert (code, page.is_absolute(), page.is_file()) == (0, True, True)
    assert typed(installed, tmp_path, "docs", "search") == (0, page.read_text(encoding="utf-8"))


RELATIVE = re.compile(r"\]\((?!https?://|#)|(?:src|href)=|^\[[^]]+\]:|^\|[|\s]*\|$", re.MULTILINE)
"""A link or picture that leads nowhere on the page of a package index, or what is left of a row of pictures."""


@pytest.mark.slow
def test_the_readme_of_a_wheel_has_no_relative_link_or_picture(installed: Path) -> None:
    (metadata,) = installed.glob("*.dist-info/METADATA")
    head, _, readme = metadata.read_text(encoding="utf-8").partition("\n\n")
    assert readme.startswith("# handeye\n")
    assert RELATIVE.findall(readme) == []
    assert re.findall("^Project-URL: (.*), ", head, re.MULTILINE)[-1] == "Bolles and Paul 1973"


def built(base: str) -> dict[str, Any]:
    """What a build says of the package where this folder is on the web."""
    hook = load_plugin_from_script(
        str(ROOT / "hatch_build.py"), "hatch_build.py", MetadataHookInterface, "hook"
    )
    config = PYPROJECT["tool"]["hatch"]["metadata"]["hooks"]["custom"]
    metadata: dict[str, Any] = {}
    hook(str(ROOT), {**config, "base": base}).update(metadata)
    return metadata


def test_with_one_base_address_every_link_of_the_readme_leads_somewhere() -> None:
    base = "https://example.org/owner/handeye"
    metadata = built(f"{base}/")
    page = metadata["readme"]["text"]
    links = set(re.findall(rf"\]\({base}/blob/HEAD/([^)#]*)", page))
    pictures = set(re.findall(rf"!\[[^]]*\]\({base}/raw/HEAD/([^)]*)\)", page))
    assert RELATIVE.findall(page) == []
    assert "docs/README.md" in links
    assert pictures
    assert {name for name in links | pictures if not (ROOT / name).exists()} == set()
    assert metadata["urls"]["Documentation"] == f"{base}/blob/HEAD/docs/README.md"
    assert [*built("")["urls"]] == ["Bolles and Paul 1973"]


@pytest.mark.parametrize(
    ("written", "nowhere", "there"),
    [
        ("see [it](docs/a.md#b).", "see it.", "see [it](B/blob/HEAD/docs/a.md#b)."),
        ("![p](a.png) [x](https://y.z)", " [x](https://y.z)", "![p](B/raw/HEAD/a.png) [x](https://y.z)"),
        ("[![p](a.png)](b.md)", "", "[![p](B/raw/HEAD/a.png)](B/blob/HEAD/b.md)"),
        ("[below](#here)", "[below](#here)", "[below](#here)"),
        ("```\nMOVE [0](1)\n```", "```\nMOVE [0](1)\n```", "```\nMOVE [0](1)\n```"),
    ],
)
def test_a_link_is_made_absolute_or_left_out(written: str, nowhere: str, there: str) -> None:
    anywhere = runpy.run_path(str(ROOT / "hatch_build.py"))["anywhere"]
    assert (anywhere(written, ""), anywhere(written, "B")) == (nowhere, there)


def test_the_package_is_cited_with_the_version_and_the_title_it_has() -> None:
    cff = (ROOT / "CITATION.cff").read_text(encoding="utf-8")
    bibtex = (ROOT / "README.md").read_text(encoding="utf-8").partition("```bibtex\n")[2]
    title = re.search(r'^title: "(.*)"$', cff, re.MULTILINE)
    assert title is not None
    assert f"title = {{{title[1]}}}" in bibtex
    assert f"version = {{{HANDEYE}}}" in bibtex
    assert f"version: {HANDEYE}\n" in cff
    assert [author["name"] for author in PROJECT["authors"]] == re.findall(
        r"^  - name: (.*)$", cff, re.MULTILINE
    )
