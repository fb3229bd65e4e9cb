"""The page of the Python names is made from their docstrings, and its first screen works."""

import doctest
import importlib.util
import re
from pathlib import Path
from types import ModuleType

import pytest

import handeye

ROOT = Path(__file__).parent.parent
PAGE = (ROOT / "docs" / "python.md").read_text(encoding="utf-8")

pytestmark = pytest.mark.slow


@pytest.fixture(scope="module")
def maker() -> ModuleType:
    """The program that writes the page."""
    spec = importlib.util.spec_from_file_location("make_reference", ROOT / "docs" / "make_reference.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


def test_the_page_is_what_the_docstrings_say(maker: ModuleType) -> None:
    assert maker.page() == PAGE, "run: python docs/make_reference.py"


def test_the_page_has_every_name() -> None:
    there = {name for name in handeye.__all__ if f"handeye.{name}" in PAGE}
    assert {*handeye.__all__} - there == {"__version__"}


def test_the_first_screen_names_what_there_is() -> None:
    first = PAGE.partition("<!--")[0]
    held = {"run": handeye.Run, "handeye": handeye, "plan": handeye.Plan, "state": handeye.State}
    named = {
        (name, member) for name, member in re.findall(r"\b(run|handeye|plan|state)\.([a-z_]+)", first)
    } - {("run", "py")}
    assert {(name, member) for name, member in named if not hasattr(held[name], member)} == set()


def test_the_examples_of_the_first_screen_do_what_they_say() -> None:
    blocks = re.findall(r"```python\n(>>> .*?)```", PAGE.partition("<!--")[0], re.DOTALL)
    test = doctest.DocTestParser().get_doctest("".join(blocks), {"handeye": handeye}, "python.md", None, 0)
    said: list[str] = []
    assert test.examples
    assert not doctest.DocTestRunner().run(test, out=said.append).failed, "".join(said)
