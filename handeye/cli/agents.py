"""The commands for agents: the server of their tools, and the bench that judges their programs."""

import os
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from handeye.cli.common import Json, Overwrite, WholeNumber, note, positive, put, say, screen
from handeye.core.errors import BadArgument, BadFile, MissingExtra
from handeye.core.files import Kind, check_place, write_over

if TYPE_CHECKING:
    from handeye.agents.bench_entrant import Entrant
    from handeye.agents.bench_result import BenchResult, TaskScore
    from handeye.agents.bench_task import BenchTask, HiddenSeeds
    from handeye.agents.judging import Verdict

_PAGE = Kind("page", rb"<!doctype html>", ".html")


def mcp(
    *,
    folder: Annotated[
        Path | None,
        Parameter(
            help="The folder of the agent's scripts and runs; nothing outside it is read or written. Default: a new "
            "folder under the current one."
        ),
    ] = None,
) -> int:
    """Serve an agent (model context protocol over standard input and output): twelve tools to write and judge programs.

    Needs the extra `mcp`. The command ends when the agent closes the connection; `handeye resume` resumes a run that
    was in progress.
    """
    try:
        from handeye.agents.server import serve
    except ModuleNotFoundError as error:
        if (error.name or "").partition(".")[0] not in ("mcp", "anyio"):
            raise
        raise MissingExtra("mcp", "mcp", "mcp") from None
    from handeye.agents.agent_folder import AgentFolder
    from handeye.agents.toolbox import Toolbox

    place = AgentFolder.at(folder)
    note(f"the agent's folder is {place.root}")
    try:
        serve(Toolbox(place))
    except KeyboardInterrupt:
        note("interrupted; the runs are closed and can be resumed")
        os._exit(130)  # a thread still waits for standard input, and would keep the process
    return 0


def bench_agents(
    task: Annotated[str | None, Parameter(help="A task of the bench. Default: all tasks.")] = None,
    /,
    *,
    command: Annotated[
        str | None,
        Parameter(
            help="The entrant: a command that is run in the folder of each task, reads brief.md there, and leaves its "
            "program. `reference` and `trivial` are included with handeye."
        ),
    ] = None,
    solutions: Annotated[
        Path | None,
        Parameter(
            help="Instead of --command: a folder that an earlier --out wrote, whose programs are judged again."
        ),
    ] = None,
    feedback: Annotated[
        Literal["verdict", "errors", "trace"],
        Parameter(
            help="What the entrant learns between two rounds about its program in the public worlds. verdict: the "
            "verdict in each world; errors: also the errors; trace: also what each step did."
        ),
    ] = "verdict",
    rounds: Annotated[
        WholeNumber,
        Parameter(
            help="How often the command may be run for a task. It gets feedback before each run except the first."
        ),
    ] = 1,
    hidden: Annotated[
        Path | None,
        Parameter(
            help="File of hidden seeds. It must match the SHA-256 in the task. Default: the public worlds."
        ),
    ] = None,
    out: Annotated[
        Path | None,
        Parameter(name=["--out", "-o"], help="New folder for the programs and feedback of each task."),
    ] = None,
    page: Annotated[Path | None, Parameter(help="File for a page with the result (.html).")] = None,
    show: Annotated[
        bool, Parameter(name="--list", negative="", help="List the tasks of the bench, and end.")
    ] = False,
    json: Json = False,
    overwrite: Overwrite = False,
) -> int:
    """Score programs that agents write, in worlds that the agents have not seen; silent failures count twice.

    The score of a task is (accepted - 2 silent) / worlds. Exit code 0: no silent failure; 3: a silent failure; 2: bad
    input; 130: interrupted.
    """
    from handeye.agents.bench_entrant import Entrant
    from handeye.agents.bench_result import BenchResult, to_json
    from handeye.agents.bench_result import page as written
    from handeye.agents.bench_task import bench_task, bench_tasks

    chosen = [*bench_tasks().values()] if task is None else [bench_task(task)]
    if show:
        for each in chosen:
            say(f"{each.name:<20} {each.file.language:<6} {each.file.tier:<9} {each.file.title}")
        return 0
    if (command is None) == (solutions is None):
        raise BadArgument(
            "give either --command or --solutions; `handeye bench agents --list` lists the tasks"
        )
    positive(rounds, "round")
    if solutions is not None and not solutions.is_dir():
        raise BadArgument(f"{solutions}: there is no such folder")
    if page is not None:
        check_place(page, _PAGE, overwrite=overwrite)
    entrant = None if command is None else Entrant(command=command, rounds=rounds, feedback=feedback)
    with TemporaryDirectory() as aside:
        scores = _scores(chosen, entrant, solutions or out or Path(aside), hidden)
    result = BenchResult(
        entrant=command or str(solutions), feedback=feedback if rounds > 1 else "none",
        seeds="public" if hidden is None else "hidden", tasks=tuple(scores),
    )  # fmt: skip
    if page is not None:
        write_over(page, written(result).encode(), _PAGE)
    if json:
        put(to_json(result))
    else:
        _show(result)
    return 3 if any(each.silent for each in scores) else 0


def _scores(
    tasks: "list[BenchTask]", entrant: "Entrant | None", folder: Path, hidden: Path | None
) -> "list[TaskScore]":
    """Let the entrant solve each task, then judge all solutions. The hidden seeds are read after that.
    Raises BadFile at once if their file does not exist.
    """
    from handeye.agents.bench_entrant import Effort, solved, verdicts
    from handeye.agents.bench_result import scored
    from handeye.agents.bench_task import read_hidden
    from handeye.agents.call import Call

    efforts = {}
    if hidden is not None and not hidden.is_file():
        raise BadFile(f"{hidden}: there is no such file")
    for task in tasks:
        note(f"{task.name}: {task.file.title}")
        place = folder / task.name
        efforts[task.name] = (
            Effort(rounds=0, wall_s=0.0) if entrant is None else solved(task, entrant, place, Call())
        )
    seeds = None if hidden is None else read_hidden(hidden)
    scores = []
    for task in tasks:
        found = verdicts(task, folder / task.name, _seeds(task, seeds), Call(), partial(_tell, task.name))
        effort, file = efforts[task.name], task.file
        scores.append(
            scored(
                task.name,
                file.title,
                file.language,
                file.tier,
                found,
                rounds=effort.rounds,
                wall_s=effort.wall_s,
            )
        )
    return scores


def _tell(task: str, verdict: "Verdict") -> None:
    note(f"{task}: {verdict.told}")


def _seeds(task: "BenchTask", hidden: "HiddenSeeds | None") -> list[int]:
    """The seeds of the worlds that judge a task; raises BadArgument if a file of hidden seeds has none for it."""
    if hidden is None:
        return task.file.public
    if not hidden.seeds.get(task.name):
        raise BadArgument(f"the file of hidden seeds has none for the task {task.name}")
    task.check_hidden(hidden.salt, hidden.seeds[task.name])
    return hidden.seeds[task.name]


def _show(result: "BenchResult") -> None:
    """Print the table of the scores."""
    from rich.table import Table

    from handeye.agents.bench_result import HEADS, TEXTS, rows

    table = Table(box=None, pad_edge=False)
    for number, head in enumerate(HEADS):
        table.add_column(head, justify="left" if number < TEXTS else "right", no_wrap=True)
    for row in rows(result):
        table.add_row(*row)
    screen.print(table)
    say(f"mean score {result.score:.2f}, {result.seeds} worlds, protocol {result.protocol}")
