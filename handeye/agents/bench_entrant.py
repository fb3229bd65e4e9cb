"""Lets an entrant of the bench solve a task: it runs the entrant's command in a folder, and gives feedback."""

import shlex
import subprocess
import time
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final, Literal

from handeye.agents.bench_task import REFERENCE, TRIVIAL, BenchTask
from handeye.agents.call import Call
from handeye.agents.judging import Verdict, judged
from handeye.core.errors import BadArgument, CannotWrite, InvalidInput
from handeye.core.files import write_whole

Feedback = Literal["verdict", "errors", "trace"]
FEEDBACK: Final = "feedback.md"  # file that the entrant finds after its first round
BUILT_IN: Final = (REFERENCE, TRIVIAL)  # entrants that need no command


@dataclass(frozen=True, slots=True, kw_only=True)
class Entrant:
    """An entrant: a command, or one of BUILT_IN."""

    command: str
    rounds: int = 1
    feedback: Feedback = "verdict"
    most_s: float = 3600.0  # wall-clock time of one round


@dataclass(frozen=True, slots=True, kw_only=True)
class Effort:
    """What an entrant spent on a task. The time differs from run to run."""

    rounds: int
    wall_s: float


def solved(task: BenchTask, entrant: Entrant, folder: Path, call: Call) -> Effort:
    """Let an entrant solve a task in a new folder, where it leaves its solution.

    After each round except the last, the solution is judged in the public worlds of the task; the entrant finds the
    feedback in FEEDBACK. If the solution is accepted in all public worlds, the rounds end early. Raises InvalidInput
    if the folder cannot be written, or if the command cannot be started.
    """
    _laid_out(task, folder)
    if entrant.command in BUILT_IN:
        for name, data in task.solution(entrant.command).items():
            write_whole(folder / name, data)
        return Effort(rounds=0, wall_s=0.0)
    began, rounds = time.monotonic(), 0
    while rounds < entrant.rounds:
        _run(entrant, folder)
        rounds += 1
        if rounds == entrant.rounds:
            break
        found = verdicts(task, folder, task.file.public, call)
        if all(each.outcome == "accepted" for each in found):
            break
        write_whole(folder / FEEDBACK, feedback(found, entrant.feedback).encode())
    return Effort(rounds=rounds, wall_s=round(time.monotonic() - began, 1))


def verdicts(
    task: BenchTask,
    folder: Path,
    seeds: Sequence[int],
    call: Call,
    tell: Callable[[Verdict], None] = lambda _: None,
) -> list[Verdict]:
    """Judge the solution in a folder in the worlds with these seeds. A solution that cannot be run has stopped in each
    of them.
    """
    try:
        setups = task.setups(folder, seeds)
    except InvalidInput as error:
        found = [Verdict(seed=seed, outcome="stopped", message=str(error)) for seed in seeds]
        tell(found[0])
        return found
    found = []
    for setup in setups:
        found.append(judged(setup, call))
        tell(found[-1])
    return found


def feedback(found: Sequence[Verdict], kind: Feedback) -> str:
    """Write the feedback on a solution: verdicts alone, or with the errors, or also with what each step did."""
    lines = ["# Your solution in the public worlds", ""]
    for each in found:
        lines.append(f"- seed {each.seed}: {each.outcome if kind == 'verdict' else each.told}")
    if kind == "trace":
        for each in found:
            if each.outcome != "accepted":
                lines += ["", f"## Seed {each.seed}: the last steps", "", "```", *each.steps, "```"]
    return "\n".join(lines) + "\n"


def _laid_out(task: BenchTask, folder: Path) -> None:
    try:
        folder.mkdir(parents=True)
    except OSError as error:
        raise CannotWrite(f"the folder {folder} cannot be created: {error.strerror}") from None
    for name, data in task.given().items():
        write_whole(folder / name, data)


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
        raise BadArgument(f"--command cannot be started: {error.strerror}: {entrant.command}") from None
