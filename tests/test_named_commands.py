"""README, docs and help name the same commands and options."""

import re
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import pytest
from cyclopts import App

from benchmarks.__main__ import app as benchmarks
from handeye.cli import app
from handeye.cli.commands import COMMANDS
from handeye.cli.usage import FORMER

ROOT = Path(__file__).parent.parent
PAGES = [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").rglob("*.md"))]
COMMAND = re.compile(r"(?:`|^\$ )handeye ([a-z]+)(?: ([a-z]+)\b)?", re.MULTILINE)
"""A command behind a prompt or a backquote, with the word after it."""
OPTION = re.compile(r"(?<![\w-])--[a-z][\w-]*")
WITH_PYTEST = {"--update"}
OF_CLUSTERS = {
    "--host",
    "--port",
    "--nworkers",
    "--nthreads",
    "--scheduler-file",
    "--ntasks",
    "--cpus-per-task",
}
"""Those of `dask` and `srun`."""
OF_THE_INSPECTOR = {
    "--cli",
    "--config",
    "--connect-timeout",
    "--method",
    "--server",
    "--strict",
    "--tool-arg",
    "--tool-name",
}
"""Those of the inspector of the model context protocol."""


def options(commands: App) -> Iterator[str]:
    """Names of the options of a command and of all below it."""
    for word in commands:
        if word.startswith("-"):
            yield word
            continue
        yield from options(commands[word])
        if commands[word].default_command is not None:
            for argument in commands[word].assemble_argument_collection(parse_docstring=True):
                yield from argument.names


@cache
def every_option() -> frozenset[str]:
    """The options of all commands; made once they are wanted, since that reads every command."""
    return frozenset([*options(app), *options(benchmarks)])


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_command_a_page_names_exists(page: Path) -> None:
    named = set(COMMAND.findall(page.read_text(encoding="utf-8")))
    groups = {word for word in app if app[word].default_command is None}
    assert {word for word, _ in named} - {*app} == set()
    assert {
        (group, word) for group, word in named if group in groups and word and word not in app[group]
    } == set()
    assert {*re.findall(r"python -m benchmarks ([a-z]+)", page.read_text(encoding="utf-8"))} <= {*benchmarks}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_every_option_a_page_names_exists(page: Path) -> None:
    named = set(OPTION.findall(page.read_text(encoding="utf-8")))
    former = set(FORMER) if page.name == "CHANGELOG.md" else set()
    assert named - every_option() - WITH_PYTEST - OF_CLUSTERS - OF_THE_INSPECTOR - former == set()


def leaves(commands: App, before: tuple[str, ...] = ()) -> Iterator[tuple[str, App]]:
    """Each command that does something, with the words that call it."""
    for word in commands:
        if word.startswith("-"):
            continue
        if commands[word].default_command is not None:
            yield " ".join((*before, word)), commands[word]
        yield from leaves(commands[word], (*before, word))


LEAVES = dict(leaves(app))


def test_the_page_of_commands_names_every_command_of_the_help() -> None:
    page = (ROOT / "docs" / "commands.md").read_text(encoding="utf-8")
    assert [name for name in LEAVES if not re.search(rf"`handeye {name}\b", page)] == []


@pytest.mark.parametrize("name", LEAVES)
def test_the_help_says_what_each_option_of_a_command_does(name: str) -> None:
    arguments = LEAVES[name].assemble_argument_collection(parse_docstring=True)
    shown = [argument for argument in arguments if argument.show]
    assert [argument.name for argument in shown if not (argument.parameter.help or "").strip()] == []


TYPED = re.compile(r"^(?:\$ )?(?:handeye|\.venv/bin/handeye|python3 run\.py) (?P<words>[^#|;>]*)")
"""A command as it is typed, up to a comment or a pipe."""


def typed(text: str) -> Iterator[str]:
    """The commands of a page: those between backquotes, and the lines of its blocks."""
    for line in [*re.findall(r"`([^`\n]+)`", text), *text.replace("\\\n", " ").splitlines()]:
        if found := TYPED.match(line):
            yield found["words"].strip()


@cache
def options_of(name: str) -> set[str]:
    """The options of one command."""
    collection = LEAVES[name].assemble_argument_collection(parse_docstring=True)
    return {option for argument in collection for option in argument.names}


def strange(words: str) -> set[str]:
    """Options that the command which begins with these words does not have."""
    named = {name for name in LEAVES if f"{words} ".startswith(f"{name} ")}
    if not named:
        return set()
    known = options_of(max(named, key=len))
    return {*OPTION.findall(words.partition(" -- ")[0])} - known - {"--help"}


@pytest.mark.parametrize("page", PAGES, ids=lambda page: str(page.relative_to(ROOT)))
def test_a_command_on_a_page_has_the_options_it_is_shown_with(page: Path) -> None:
    commands = [*typed(page.read_text(encoding="utf-8"))]
    assert {words: strange(words) for words in commands if strange(words)} == {}


def test_an_option_of_another_command_is_strange() -> None:
    assert strange("trace show pump --seed 3") == {"--seed"}
    assert strange("report pump -o x.html --overwrite") == set()


def test_lists_say_of_a_command_what_its_docstring_says_first() -> None:
    listed = {}
    for line in COMMANDS.strip().splitlines():
        named, sentence = line.split(": ", 1)
        listed[named.partition(" = ")[0]] = sentence
    first = {}
    for name in listed:
        command = app
        for word in name.split():
            command = command[word]
        first[name] = " ".join(command.help.split("\n\n")[0].split())
    assert first == listed
