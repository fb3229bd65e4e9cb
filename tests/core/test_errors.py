"""The tree of exceptions is the one that its docstring prints."""

import re

import handeye
from handeye.api.diagnostic import ScriptError
from handeye.core import errors
from handeye.core.errors import MissingExtra
from handeye.runs.folder import HoldsRun

ELSEWHERE = (ScriptError, MissingExtra, HoldsRun)


def printed() -> dict[str, str]:
    """The base of each exception, as the docstring draws it."""
    bases: dict[str, str] = {}
    above: dict[int, str] = {}
    for indent, name in re.findall(r"^    ([│├└─ ]*)([A-Z]\w+)", errors.__doc__ or "", re.MULTILINE):
        depth = len(indent) // 4
        above[depth] = name
        bases[name] = above[depth - 1] if depth else "Exception"
    return bases


def test_every_exception_stands_where_the_docstring_prints_it() -> None:
    here = [each for each in vars(errors).values() if isinstance(each, type)]
    assert {each.__name__: each.__base__.__name__ for each in [*here, *ELSEWHERE]} == printed()


def test_what_was_given_wrong_is_told_apart_from_physics_that_fails() -> None:
    wrong = {handeye.BadArgument, handeye.NoSuchName, handeye.BadFile, handeye.CannotWrite, handeye.Refused}
    assert all(issubclass(each, handeye.InvalidInput) for each in {*wrong, handeye.ScriptError})
    assert not issubclass(handeye.PhysicsFailed, handeye.InvalidInput)
