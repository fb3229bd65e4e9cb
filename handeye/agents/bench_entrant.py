"""Lets an entrant of the bench solve a task: runs the entrant's command in a folder, and gives feedback."""

import os
import shlex
import subprocess
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from handeye.agents.bench_feedback import FEEDBACK, Feedback, feedback
from handeye.agents.bench_task import BUILT_IN, BenchTask
from handeye.agents.call import Call
from handeye.agents.judging import Verdict, judged
from handeye.core.errors import BadArgument, CannotWrite, InvalidInput
from handeye.core.files import write_whole


@dataclass(frozen=True, slots=True, kw_only=True)
class Entrant:
    """An entrant: a command, or one of BUILT_IN."""

    command: str
    rounds: int = 1
    feedback: Feedback = "verdict"
    most_s: float = 3600.0  # wall-clock time of one round


@dataclass(frozen=True, slots=True, kw_only=True)
class Effort:
    """The rounds and the wall-clock time that an entrant needed for a task. This time differs from run to run."""

    rounds: int = 0
    wall_s: float = 0.0
    barred: str = ""  # why the entrant has lost the task before it was judged; empty if it has not


def solved(task: BenchTask, entrant: Entrant, folder: Path, call: Call) -> Effort:
    """Let an entrant solve a task in a new folder. The entrant leaves its solution in this folder.

    After each round except the last, the solution is judged in the public worlds of the task; the entrant finds the
    feedback in FEEDBACK. If the solution is accepted in all public worlds, the rounds end early. Raises InvalidInput
    if the folder cannot be written, or if the command cannot be started.
    """
    lay_out(task, folder)
    if entrant.command in BUILT_IN:
        for name, data in task.solution(entrant.command).items():
            write_whole(folder / name, data)
        return Effort()
    began, rounds, barred = time.monotonic(), 0, ""
    while rounds < entrant.rounds and not barred:
        _run(entrant, folder)
        rounds += 1
        barred = _blocked(folder)
        if rounds == entrant.rounds or barred:
            break
        found = verdicts(task, folder, task.file.public, call)
        if all(each.outcome == "accepted" for each in found):
            break
        write_whole(folder / FEEDBACK, feedback(found, entrant.feedback).encode())
    return Effort(rounds=rounds, wall_s=round(time.monotonic() - began, 1), barred=barred)


def _blocked(folder: Path) -> str:
    """Return the reason why handeye cannot use the folder that an entrant has left, or an empty text if handeye can
    use this folder.
    """
    if folder.is_symlink() or not os.access(folder, os.R_OK | os.W_OK | os.X_OK):
        return "the entrant has removed, replaced or locked the folder of the task"
    place = folder / FEEDBACK
    if os.path.lexists(place) and (place.is_symlink() or not place.is_file()):
        return f"the entrant has put something other than a file in the place of {FEEDBACK}"
    return ""


def verdicts(
    task: BenchTask,
    folder: Path,
    seeds: Sequence[int],
    call: Call,
    tell: Callable[[Verdict], None] = lambda _: None,
) -> list[Verdict]:
    """Judge the solution in a folder, in one world for each of the seeds. If a solution must work in every order of
    its concurrent tasks, it is judged only once, in all these orders. A solution that cannot be run counts as stopped
    in each of the worlds.
    """
    try:
        if task.file.orders:
            found = [_in_every_order(task, folder)]
            tell(found[0])
            return found
        setups = task.setups(folder, seeds)
    except InvalidInput as error:
        return lost(task, seeds, str(error), tell)
    found = []
    for seed, setup in zip(seeds, setups, strict=True):
        found.append(judged(setup, call, task.case(seed).right))
        tell(found[-1])
    return found


def lost(
    task: BenchTask, seeds: Sequence[int], why: str, tell: Callable[[Verdict], None] = lambda _: None
) -> list[Verdict]:
    """Return the verdicts on a solution that cannot be judged: the solution counts as stopped in every world."""
    judged_in = task.file.public[:1] if task.file.orders else seeds
    found = [Verdict(seed=seed, outcome="stopped", message=why) for seed in judged_in]
    tell(found[0])
    return found


def _in_every_order(task: BenchTask, folder: Path) -> Verdict:
    """Judge a solution in every order in which its concurrent tasks can run."""
    seed, problems = task.file.public[0], task.problems(folder)
    if not problems:
        return Verdict(seed=seed, outcome="accepted", listed=False)
    silent, told = problems[0]
    if silent:
        return Verdict(seed=seed, outcome="silent", rejected=(told,), listed=False)
    return Verdict(seed=seed, outcome="stopped", message=told, listed=False)


def lay_out(task: BenchTask, folder: Path) -> list[str]:
    """Put the brief and the given files of a task into a new folder. Returns the names of all these files. Raises
    CannotWrite if the folder exists or cannot be created.
    """
    try:
        folder.mkdir(parents=True)
    except OSError as error:
        raise CannotWrite(f"the folder {folder} cannot be created: {error.strerror}") from None
    given = task.given()
    for name, data in given.items():
        write_whole(folder / name, data)
    return [*given]


def _run(entrant: Entrant, folder: Path) -> None:
    """Run the command of an entrant once, in its folder. If the command fails, the files that it has written remain."""
    try:
        words = shlex.split(entrant.command)
        if not words:
            raise BadArgument("--command is empty")
        subprocess.run(  # noqa: S603 - the command that the user gave
            words, cwd=folder, stdin=subprocess.DEVNULL, stdout=2, check=False, timeout=entrant.most_s
        )
    except subprocess.TimeoutExpired:
        pass
    except ValueError as error:
        raise BadArgument(f"--command cannot be used: {error}") from None
    except OSError as error:
        raise BadArgument(f"the command cannot be started: {error.strerror}: {entrant.command}") from None
