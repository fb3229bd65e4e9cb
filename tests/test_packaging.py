"""What pyproject.toml says of the package is so, and the locks hold what it asks for."""

import os
import re
import shutil
import subprocess
import sys
import tarfile
import tomllib
from importlib.metadata import EntryPoint
from pathlib import Path

import pytest
from hatchling.builders.sdist import SdistBuilder
from hatchling.builders.wheel import WheelBuilder
from import_reading import imports
from packaging.requirements import Requirement
from packaging.utils import canonicalize_name

from handeye.core.versions import HANDEYE

ROOT = Path(__file__).parent.parent
PYPROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))
PROJECT = PYPROJECT["project"]
DEPENDENCIES = [Requirement(text) for text in PROJECT["dependencies"]]
EXTRAS = [
    Requirement(text)
    for extra, texts in PROJECT["optional-dependencies"].items()
    if extra != "notebooks"  # which runs the notebooks, and is imported by none of the package
    for text in texts
]
BUILDING = [Requirement(text) for text in PYPROJECT["dependency-groups"]["build"]]
TESTING = [Requirement(text) for text in PYPROJECT["dependency-groups"]["dev"]]
PACKAGE_OF = {"cv2": "opencv-python-headless", "google": "protobuf"}
"""Packages whose modules have other names."""


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


PEERS = {"pandas", "roboticstoolbox"}
"""What handeye hands tables to, or is measured beside, where somebody has it; elsewhere it says so."""


@pytest.mark.slow
def test_what_the_package_imports_and_what_it_asks_for_are_the_same() -> None:
    modules = (ROOT / "handeye").rglob("*.py")
    imported = {name.split(".")[0] for m in modules for name in imports(m.read_text("utf-8"), m.stem)}
    foreign = imported - sys.stdlib_module_names - PEERS - {"handeye"}
    asked = {canonicalize_name(wanted.name) for wanted in DEPENDENCIES + EXTRAS}
    assert {canonicalize_name(PACKAGE_OF.get(name, name)) for name in foreign} == asked


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


@pytest.mark.slow
def test_a_wheel_out_of_the_source_distribution_runs_in_an_empty_folder(
    installed: Path, tmp_path: Path
) -> None:
    done = subprocess.run(
        [sys.executable, "-m", "handeye", "check", "water_pump"],
        cwd=tmp_path,
        env={**os.environ, "PYTHONPATH": str(installed), "PYTHONSAFEPATH": "1"},
        capture_output=True,
        text=True,
        check=False,
    )
    assert (done.returncode, done.stdout) == (
        0,
        f"{installed}/handeye/_data/plans/water_pump.al: no errors\n",
    )
