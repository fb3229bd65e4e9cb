"""Writes the last paragraphs of each brief of the agents' bench. Their text depends mainly on the language of the
task.
"""

import tomllib
from pathlib import Path
from typing import TYPE_CHECKING

import msgspec

from handeye.agents.judging import MOST_SECONDS, MOST_STEPS
from handeye.core.errors import BadFile
from handeye.core.source import read_source

if TYPE_CHECKING:
    from handeye.agents.bench_task import BenchTask


class Phrases(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The phrases about one language that the end of a brief uses."""

    stops: str  # how a program stops
    check: str  # the command that checks one
    checked: str  # what this command does


def phrases(folder: Path, language: str) -> Phrases:
    """Return the phrases for a language. Raises BadFile if the bench has no phrases for that language."""
    file = folder / "languages.toml"
    try:
        return msgspec.convert(tomllib.loads(read_source(file).text), dict[str, Phrases])[language]
    except (KeyError, tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
        raise BadFile(f"{file} cannot be used for programs in .{language}: {error}") from None


def end_of_brief(task: "BenchTask", own: str) -> str:
    """Return the paragraphs that end the brief of a task: what counts, and how to try a program. `own` is the text
    that comes before these paragraphs.
    """
    file, program = task.file, task.program
    taught = ", with its taught positions in `solution.toml`" if file.language == "al" else ""
    told = phrases(task.folder.parent, file.language)
    lists = " What this brief says about the worlds replaces what `handeye world` lists." * (
        "handeye world" in own
    )
    check = told.check.format(program=program, task=file.task)
    return (
        f"**What to leave.** Your program, as `{program}` in this folder{taught}.\n\n"
        f"**What counts.** Score: (accepted - 2 silent) / worlds. {_counts(task, told)}\n\n"
        f"**How to try it.** `handeye bench agents {task.name} --try .` judges your program {_where(task)}. "
        f"`handeye {check}` {told.checked}.{lists} {_manual(task)}\n"
    )


def _counts(task: "BenchTask", told: Phrases) -> str:
    if task.file.orders:
        return (
            "A program is a silent failure if, in at least one order of its tasks, it ends as if all were well "
            "although the work is wrong; it is then a silent failure even if it stops in another order. Any other "
            "program that stops in at least one order, for example in a deadlock, counts as stopped."
        )
    return (
        f"A program that is not sure must stop: {task.file.stopping or told.stops}. A program is a silent failure "
        "if it ends as if all were well although the work is wrong. A program that has not ended after "
        f"{MOST_SECONDS:,.0f} simulated seconds or {MOST_STEPS:,} steps counts as stopped."
    )


def _where(task: "BenchTask") -> str:
    if task.file.orders:
        return "in every order of its tasks"
    first, last = task.file.public[0], task.file.public[-1]
    between = "and" if len(task.file.public) == 2 else "to"
    return (
        f"in the public worlds, which have the seeds {first} {between} {last}; with `--feedback trace`, it also shows "
        "the last steps"
    )


def _manual(task: "BenchTask") -> str:
    if task.file.tier == "bare":
        return "The manual is not allowed in this task: do not use `handeye docs` or `handeye explain`."
    pages = [f"`handeye docs {page}`" for page in task.file.manual]
    return (
        f"The manual: {', '.join(pages[:-1])} and {pages[-1]}."
        if len(pages) > 1
        else f"The manual: {pages[0]}."
    )
