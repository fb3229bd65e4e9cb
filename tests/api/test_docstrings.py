"""Every public name says what it is, and the example in it does what it says."""

import doctest
import inspect
from pathlib import Path

import pytest

import handeye
from handeye.core import errors

pytestmark = pytest.mark.slow

OBJECTS = [
    name
    for name in handeye.__all__
    if inspect.isclass(getattr(handeye, name)) or inspect.isfunction(getattr(handeye, name))
]
ERRORS = {name for name, cls in vars(errors).items() if inspect.isclass(cls)}
PLAIN = {*ERRORS, "Comparison", "Result", "Task", "Trace"}
"""Names whose examples are those of what makes them."""
FINDER = doctest.DocTestFinder()


def examples(name: str, folder: Path) -> list[doctest.DocTest]:
    """The examples of a name and of what is in it."""
    around = {"handeye": handeye, "folder": folder}
    return [
        test
        for test in FINDER.find(getattr(handeye, name), name, module=False, globs=around)
        if test.examples
    ]


@pytest.mark.parametrize("name", OBJECTS)
def test_every_name_says_what_it_is(name: str) -> None:
    named = getattr(handeye, name)
    members = inspect.getmembers(
        named, lambda member: isinstance(member, property) or inspect.isfunction(member)
    )
    silent = [each for each, member in members if not each.startswith("_") and not inspect.getdoc(member)]
    assert (bool(inspect.getdoc(named)), silent) == (True, [])


@pytest.mark.parametrize("name", OBJECTS)
def test_the_examples_do_what_they_say(name: str, tmp_path: Path) -> None:
    found = examples(name, tmp_path / "run")
    assert found or name in PLAIN
    for test in found:
        said: list[str] = []
        failed = doctest.DocTestRunner(optionflags=doctest.ELLIPSIS).run(test, out=said.append).failed
        assert not failed, "".join(said)


def test_the_example_of_the_package_does_what_it_says() -> None:
    (test,) = [
        test for test in doctest.DocTestFinder(recurse=False).find(handeye, "handeye") if test.examples
    ]
    assert doctest.DocTestRunner().run(test).failed == 0
