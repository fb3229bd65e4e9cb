"""The public door: three functions that stay functions whatever is imported."""

import importlib
import pkgutil
import tomllib
from pathlib import Path

import pytest

import handeye
from handeye.errors import InvalidInput
from handeye.planfile.plan import Plan
from handeye.trace.trace import Trace

pytestmark = pytest.mark.slow

SCRIPT = """\
        STAGE   "shut the hand"
        OPEN    .5
        OPEN    .4
"""


@pytest.fixture(scope="module", autouse=True)
def everything() -> None:
    """Every submodule has been imported, so that one that bore the name of a function would have taken its place."""
    for found in pkgutil.walk_packages(handeye.__path__, "handeye."):
        if not found.name.endswith("__main__"):
            importlib.import_module(found.name)


@pytest.fixture(scope="module")
def script(tmp_path_factory: pytest.TempPathFactory) -> Path:
    file = tmp_path_factory.mktemp("door") / "short.al"
    file.write_text(SCRIPT, encoding="utf-8")
    return file


def test_a_script_becomes_a_plan(script: Path) -> None:
    made = handeye.plan(script)
    assert isinstance(made, Plan)
    assert made.program.stages == ("shut the hand",)


def test_a_script_with_mistakes_is_refused_with_all_of_them(tmp_path: Path) -> None:
    (tmp_path / "wrong.al").write_text("OPNE 3\nMOVE NOWHERE\n", encoding="utf-8")
    with pytest.raises(InvalidInput, match=r"(?s)OPNE.*NOWHERE"):
        handeye.plan(tmp_path / "wrong.al")


def test_a_script_is_carried_out_and_its_trace_opened(script: Path, tmp_path: Path) -> None:
    result = handeye.assemble(seed=3, script=script, camera="ray", out=tmp_path / "run")
    trace = handeye.open(tmp_path / "run")
    assert (result.completed, result.seed) == (True, 3)
    assert isinstance(trace, Trace)
    assert trace.head.program == "short"


def test_a_file_that_is_no_trace_is_refused(script: Path) -> None:
    with pytest.raises(InvalidInput, match="is not a trace"):
        handeye.open(script)


def test_the_version_is_that_of_the_package() -> None:
    project = Path(__file__).parent.parent / "pyproject.toml"
    assert handeye.__version__ == tomllib.loads(project.read_text(encoding="utf-8"))["project"]["version"]


@pytest.mark.parametrize(
    "words", [{"seed": -1}, {"seed": "3"}, {"seed": 1.5}, {"world": 3}, {"world": {"seed": 3}}]
)
def test_a_seed_or_a_world_that_is_none_is_refused(words: dict[str, object]) -> None:
    with pytest.raises(InvalidInput, match=r"^the (seed|world) must be a"):
        handeye.assemble(**words)
