"""The player's script is one piece that a page can carry and name the hash of."""

import re
from collections import Counter

from handeye.report.player import MODULES, SOURCES, script
from handeye.report.player.tracks import UNIT


def test_nothing_is_imported_or_exported() -> None:
    assert re.findall(r"^\s*(?:import|export)\b.*", script(), re.MULTILINE) == []


def test_no_two_modules_call_different_things_the_same() -> None:
    text = "".join((SOURCES / f"{name}.js").read_text("utf-8") for name in MODULES)
    first = re.findall(r"^(?:export )?(?:async )?(?:const|let|function|class) (\w+)", text, re.MULTILINE)
    more = [re.findall(r", ([A-Z]+) = ", line) for line in re.findall(r"^const .*", text, re.MULTILINE)]
    names = Counter([*first, *(name for line in more for name in line)])
    assert {name for name, count in names.items() if count > 1} == set()
    assert len(names) > len(MODULES)


def test_every_module_is_in_it() -> None:
    assert {path.stem for path in SOURCES.iterdir()} == {*MODULES}


def test_nothing_that_a_strict_page_forbids_is_in_it() -> None:
    assert re.findall(r"\beval\b|new Function|</script|\.style\b|innerHTML|https?:|fetch\(", script()) == []


def test_the_script_knows_what_one_is_in_a_quaternion() -> None:
    assert f"const UNIT = {UNIT:#x};" in script()
