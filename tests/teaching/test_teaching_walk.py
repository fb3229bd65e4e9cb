"""The walk in docs/teaching.md: what is typed there gets the answers that stand there, but for figures."""

import re
from pathlib import Path

import pytest
from conftest import Command

pytestmark = pytest.mark.slow

DOC = (Path(__file__).parents[2] / "docs" / "teaching.md").read_text(encoding="utf-8")
TALKS = re.findall(r"^```\n\$ handeye (repl|teach)([^\n]*)\n(.*?)^```$", DOC, re.MULTILINE | re.DOTALL)
FILE, NEW = re.findall(r"^```toml\n(.*?)^```$", DOC, re.MULTILINE | re.DOTALL)
PROMPTS = {"repl": "*", "teach": "teach>"}


def without_figures(text: str) -> str:
    """Text in which every figure with a point, and 0, is a `#`: the last digit is the processor's."""
    return re.sub(r"-?\d+\.\d+|-?\b0\b", "#", text)


def test_the_page_has_two_talks_with_repl_and_one_with_teach() -> None:
    assert [word for word, _, _ in TALKS] == ["repl", "repl", "teach"]


@pytest.mark.parametrize(("word", "rest", "talk"), TALKS)
def test_what_is_typed_in_the_walk_gets_the_answers_that_stand_there(
    command: Command, word: str, rest: str, talk: str
) -> None:
    Path("job.toml").write_text(FILE, encoding="utf-8")
    prompt = PROMPTS[word]
    typed = [line.removeprefix(prompt).strip() for line in talk.splitlines() if line.startswith(prompt)]
    answered = [line for line in talk.splitlines() if not line.startswith(prompt)]
    _, out, _ = command(word, *rest.split(), typed="".join(f"{line}\n" for line in typed))
    assert typed
    assert without_figures(out).splitlines() == without_figures("\n".join(answered)).splitlines()


def test_the_file_of_the_walk_has_one_line_more(command: Command) -> None:
    Path("job.toml").write_text(FILE, encoding="utf-8")
    command("teach", "job.al", typed="here PIN of HOLDER\nsave\n")
    now = Path("job.toml").read_text(encoding="utf-8").splitlines()
    (line,) = [line for line in now if line not in FILE.splitlines()]
    assert without_figures(line) == without_figures(NEW.strip())
