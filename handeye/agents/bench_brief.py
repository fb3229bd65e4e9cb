"""Writes the end of a brief of the agents' bench, which is the same for all tasks of a language."""

from typing import TYPE_CHECKING, Final

from handeye.agents.judging import MOST_SECONDS, MOST_STEPS

if TYPE_CHECKING:
    from handeye.agents.bench_task import BenchTask

_STOPS: Final = {
    "al": 'an untested error calls the operator, and so does `WAIT "..."`',
    "trig": "the arm stops when it cannot do a step",
    "ml": "its last printed line begins with the number of a trouble, such as 1",
    "mal": '`STOP "..."` stops it with a message',
}  # how a program stops, by language
_CHECKS: Final = {
    "al": "check {program} --task {task}",
    "trig": "trig run {program}",
    "ml": "ml check {program}",
    "mal": "sigma check {program}",
}
_CHECKED: Final = {
    "trig": "runs the script in a world without errors and without physics",
}  # what these commands do, if they do more than to find mistakes


def end_of_brief(task: "BenchTask") -> str:
    """Return the paragraphs that end the brief of a task: what counts, and how to try a program."""
    file, program = task.file, task.program
    taught = ", with its taught positions in `solution.toml`" if file.language == "al" else ""
    check = _CHECKS[file.language].format(program=program, task=file.task)
    checked = _CHECKED.get(file.language, "finds mistakes")
    return (
        f"**What to leave.** Your program, as `{program}` in this folder{taught}.\n\n"
        f"**What counts.** Score: (accepted - 2 silent) / worlds. {_counts(task)}\n\n"
        f"**How to try it.** `handeye bench agents {task.name} --try .` judges your program {_where(task)}. "
        f"`handeye {check}` {checked}. {_manual(task)}\n"
    )


def _counts(task: "BenchTask") -> str:
    if task.file.orders:
        return (
            "If a program can stop in some order, for example in a deadlock, it counts as stopped. If it can be wrong "
            "without noticing it, this is a silent failure, also if it can stop in another order."
        )
    stops = task.file.stopping or _STOPS[task.file.language]
    return (
        f"A program that is not sure must stop: {stops}. A program that ends as if all were well "
        "although the work is wrong is a silent failure. A program that has not ended after "
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
        return "This task is without the manual: do not use `handeye docs` or `handeye explain`."
    pages = [f"`handeye docs {page}`" for page in task.file.manual]
    return (
        f"The manual: {', '.join(pages[:-1])} and {pages[-1]}."
        if len(pages) > 1
        else f"The manual: {pages[0]}."
    )
