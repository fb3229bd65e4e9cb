"""The pages about ML show what happens; `pytest FILE --update -n 0` writes it into them."""

import doctest
import re
import shlex
import shutil
from collections.abc import Callable
from importlib.util import module_from_spec, spec_from_file_location

import pytest
from ml_bench import FOLLOWER, ROOT
from walked_pages import walked, with_outputs

from handeye.core.errors import InvalidInput
from handeye.systems.ml.cli.console import Console

Command = Callable[..., tuple[int, str, str]]
PAGE = ROOT / "docs/ml.md"
TABLE = re.compile(r"stages  |arm  |computer  ")
"""The end of every run, which the page leaves out."""
PYTHON = re.compile(r"^```python\n(.*?)^```$", re.MULTILINE | re.DOTALL)


@pytest.mark.slow
def test_the_tutorial_shows_what_happens(command: Command, request: pytest.FixtureRequest) -> None:
    printed: list[str] = []
    terminal = Console(printed.append)

    def run(line: str) -> tuple[int, str]:
        code, out, err = command(*shlex.split(line))
        seen = err + out if "check" in line else out
        rows = [row.rstrip() for row in seen.splitlines() if not TABLE.match(row)]
        return code, "\n".join(rows).rstrip() + "\n"

    def type_line(line: str) -> tuple[int, str]:
        printed.clear()
        try:
            terminal.hear(line)
        except InvalidInput as error:
            printed.append(str(error))
        return 0, "".join(f"{row}\n" for row in printed)

    typed = walked(PAGE.read_text(encoding="utf-8"), run, type_line)
    if request.config.getoption("--update"):
        PAGE.write_text(with_outputs(PAGE.read_text(encoding="utf-8"), typed), encoding="utf-8")
        return
    assert [(each.line, each.shown, each.printed) for each in typed if not each.stands] == []
    assert len(typed) >= 25


def test_the_python_of_the_tutorial_does_what_it_shows(command: Command) -> None:
    shutil.copy(FOLLOWER, ".")
    text = "\n".join(PYTHON.findall(PAGE.read_text(encoding="utf-8")))
    test = doctest.DocTestParser().get_doctest(text, {}, "ml.md", None, 0)
    assert doctest.DocTestRunner().run(test).failed == 0


def test_the_page_of_commands_is_made_from_the_tables() -> None:
    spec = spec_from_file_location("make_ml_commands", ROOT / "docs/make_ml_commands.py")
    assert spec is not None
    assert spec.loader is not None
    made = module_from_spec(spec)
    spec.loader.exec_module(made)
    assert made.PAGE.read_text(encoding="utf-8") == made.page()
