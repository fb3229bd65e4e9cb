"""The lines on the pages about kinematics and controllers do what they say."""

import doctest
import re
from pathlib import Path

import numpy as np
import pytest

DOCS = Path(__file__).parent.parent / "docs"


@pytest.mark.slow
@pytest.mark.parametrize("page", ["kinematics.md", "controllers.md"])
def test_the_lines_of_the_page_do_what_they_say(page: str) -> None:
    text = (DOCS / page).read_text(encoding="utf-8")
    blocks = re.findall(r"```python\n(>>> .*?)```", text, re.DOTALL)
    test = doctest.DocTestParser().get_doctest("".join(blocks), {}, page, None, 0)
    said: list[str] = []
    with np.printoptions():
        failed = doctest.DocTestRunner().run(test, out=said.append).failed
    assert (bool(test.examples), failed) == (True, 0), "".join(said)
