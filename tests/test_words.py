"""The words of the project: plain English in whatever a person reads. CONTRIBUTING.md has the list."""

import json
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from habits import ANY, HABITS, habits, prose_of_page, prose_of_python

ROOT = Path(__file__).parent.parent
PACKAGE = sorted(folder.name for folder in (ROOT / "handeye").iterdir() if (folder / "__init__.py").exists())
PAGES = sorted(str(page.relative_to(ROOT)) for page in (ROOT / "docs").rglob("*.md"))
ROOMS = [
    *(f"handeye/{folder}" for folder in PACKAGE),
    *PAGES,
    "README.md",
    "CONTRIBUTING.md",
    "docs/*.py",
    "notebooks",
    "examples",
    "benchmarks",
    "editors",
    "scenes",
    "run.py",
]
"""Folders, pages and files whose words are searched."""
NOT_YET = set((Path(__file__).parent / "words_not_yet.txt").read_text(encoding="utf-8").splitlines())
"""Rooms that still have habits; the list only shrinks."""


def files(room: str) -> list[Path]:
    """The files of a room."""
    if "*" in room:
        return sorted(ROOT.glob(room))
    if (ROOT / room).is_file():
        return [ROOT / room]
    return sorted(
        file
        for file in (ROOT / room).rglob("*.*")
        if file.suffix in (".py", ".js", ".md", ".ipynb", ".toml") and "__pycache__" not in file.parts
    )


def prose(file: Path) -> Iterator[tuple[int, str]]:
    """What a file has for readers, by line."""
    source = file.read_text(encoding="utf-8")
    if not ANY.search(re.sub(r"[\s#\"']+", " ", source)):
        return
    if file.suffix == ".py":
        yield from prose_of_python(source)
    elif file.suffix == ".ipynb":
        for number, cell in enumerate(json.loads(source)["cells"], 1):
            if cell["cell_type"] == "markdown":
                yield from ((number, text) for _, text in prose_of_page("".join(cell["source"])))
    elif file.name == "CONTRIBUTING.md":  # the list itself names them
        yield from prose_of_page(re.sub(r"^\| we do not write .*?\n\n", "\n", source, flags=re.M | re.S))
    elif file.suffix == ".md":
        yield from prose_of_page(source)
    elif file.suffix == ".js":  # comments and texts
        for number, line in enumerate(source.splitlines(), 1):
            yield number, " ".join(re.findall(r"//.*|/?\*.*|\"[^\"]*\"|`[^`]*", line))
    else:
        yield from enumerate(source.splitlines(), 1)


def found(room: str) -> list[str]:
    """The habits in a room, each with file and line."""
    return [
        f"{file.relative_to(ROOT)}:{line}: {habit}"
        for file in files(room)
        for line, text in prose(file)
        for habit in habits(text)
    ]


@pytest.mark.slow
@pytest.mark.parametrize("room", ROOMS)
def test_a_room_has_no_habits(room: str) -> None:
    habits = found(room)
    if room in NOT_YET:
        assert habits, f"{room} is clean: take it out of tests/words_not_yet.txt"
    else:
        assert not habits, "\n".join(habits)


SENTENCES = [
    ("so many", "it does that so many times"),
    ("so much more", "errors so much larger"),
    ("somebody, nobody", "worlds that nobody had seen"),
    ("is told", "the referee is not told where it is"),
    ("is told", "they are told apart"),
    ("tells of", "the page tells of it"),
    ("comes to", "the program came to its end"),
    ("comes along", "a run that comes along"),
    ("otherwise, for differently", "what went otherwise first"),
    ("a thing", "without pushing the thing"),
    ("ways part", "Their ways part here"),
    ("looks on", "any number look on, one drives"),
    ("as it was drawn", "a world as it was drawn"),
    ("goes by", "while the script goes by"),
    ("people are", "as people are shown it"),
    ("hands on", "it hands on what it has"),
    ("stands beside, stands in", "the old one stands beside it"),
    ("stands beside, stands in", "it stands in the table"),
    ("is known of", "what is known of it"),
    ("at that, after a comma", "a small one at that."),
    ("anew", "the count starts anew"),
    ("but for", "equal but for rounding"),
    ("whoever", "whoever asks"),
    ("Who presses it", "It stops. Who presses it twice leaves."),
    ("carries out a run", "the script is carried out"),
    ("carries out a run", "it carries out the script"),
    ("seconds of the host", "Seconds of the host have a file"),
    ("is lacking", "senses that are lacking"),
    ("is not there", "a file that is not there"),
]


@pytest.mark.parametrize(("habit", "sentence"), SENTENCES)
def test_a_habit_is_seen(habit: str, sentence: str) -> None:
    assert [seen.partition(":")[0] for seen in habits(sentence)] == [habit]


def test_each_habit_has_a_sentence_and_is_in_the_word_list() -> None:
    listed = (ROOT / "CONTRIBUTING.md").read_text(encoding="utf-8")
    assert {habit for habit, _ in SENTENCES} == set(HABITS)
    assert [habit for habit in HABITS if f"| {habit} |" not in listed] == []


@pytest.mark.parametrize(
    "sentence",
    [
        "Otherwise, the program ends.",
        "the error if one was raised, or otherwise the next step",
        "which would otherwise be read twice",
        "the arm comes to rest",
        "anything, nothing and something",
        "the same thing",
        "it looks on the belt",
        "at that time",
        "Who did it?",
        "THE DRIVER DOES NOT STAND IN ITS RACK, SO MANY",
        "`told` and `anew` are names",
        "people who know the arm language",
    ],
)
def test_good_english_is_left_alone(sentence: str) -> None:
    assert list(habits(sentence)) == []


def test_texts_docstrings_comments_and_pages_are_searched() -> None:
    source = '"""Made anew."""\nx = f"{told} goes by {x}"\ny = (\n    "so "\n    "many"\n)\n# nobody\n# but for one\n'
    assert [(line, seen.partition(":")[0]) for line, text in prose_of_python(source) for seen in habits(text)] == [
        (1, "anew"), (2, "goes by"), (4, "so many"), (7, "somebody, nobody"), (7, "but for")
    ]  # fmt: skip
    page = "so\nmany\n\n> nobody\n\n```al\n; anew\n```\n\n```\nbut for\n```\n"
    assert [seen.partition(":")[0] for _, text in prose_of_page(page) for seen in habits(text)] == [
        "so many",
        "but for",
    ]
