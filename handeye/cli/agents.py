"""The commands for agents: the server of their tools, and the bench that judges their programs."""

import os
from functools import partial
from pathlib import Path
from tempfile import TemporaryDirectory
from typing import TYPE_CHECKING, Annotated, Literal

from cyclopts import Parameter

from handeye.cli.common import Json, Overwrite, WholeNumber, note, positive, put, put_json, say, screen
from handeye.core.errors import BadArgument, BadFile, MissingExtra
from handeye.core.files import check_place, write_over

if TYPE_CHECKING:
    from handeye.agents.bench_entrant import Entrant
    from handeye.agents.bench_result import BenchResult, TaskScore
    from handeye.agents.bench_task import BenchTask
    from handeye.agents.hidden_seeds import HiddenSeeds
    from handeye.agents.judging import Verdict


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
    """Offer an agent twelve tools to write and judge programs, over standard input and output (model context protocol).

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
            help="The entrant: a command. It runs in the folder of each task, reads brief.md, and writes its "
            "program into this folder. The entrants `reference` and `trivial` are included with handeye."
        ),
    ] = None,
    brief: Annotated[
        Path | None,
        Parameter(
            help="Instead of --command: write the brief and the given files to this new folder, and judge nothing. "
            "If several tasks are chosen, the folder contains one folder for each task."
        ),
    ] = None,
    attempt: Annotated[
        Path | None,
        Parameter(
            name="--try",
            help="Instead of --command: a folder, such as `.`, that contains one program for the task. The program "
            "is judged in the public worlds, and the command prints the feedback.",
        ),
    ] = None,
    check: Annotated[
        bool,
        Parameter(
            negative="",
            help="Check the tasks: the referee must accept the reference solution in all public worlds, and the "
            "trivial program must not pass.",
        ),
    ] = False,
    solutions: Annotated[
        Path | None,
        Parameter(
            help="Instead of --command: a folder that an earlier `handeye bench agents` wrote with --out. The "
            "programs in this folder are judged again."
        ),
    ] = None,
    feedback: Annotated[
        Literal["verdict", "errors", "trace"] | None,
        Parameter(
            help="Feedback that the entrant gets between two rounds, from the runs of its program in the public "
            "worlds. verdict: the verdict in each world. errors: also the errors, and for each accepted run, what "
            "the referee measured. trace: also what the last steps of each other run did. Default: verdict; with "
            "--try: errors."
        ),
    ] = None,
    rounds: Annotated[
        WholeNumber,
        Parameter(
            help="How many times the command may be run for a task. The command gets feedback before each run "
            "except the first."
        ),
    ] = 1,
    hidden: Annotated[
        Path | None,
        Parameter(
            help="File of hidden seeds. The file must match the SHA-256 in the task. Default: the public worlds."
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

    The score of a task is (accepted - 2 silent) / worlds. Exit code 0: no silent failure; 1: --check found a mistake
    in a task; 3: a silent failure; 2: bad input; 130: interrupted.
    """
    from handeye.agents.bench_entrant import Entrant
    from handeye.agents.bench_page import PAGE, bench_page
    from handeye.agents.bench_result import BenchResult, to_json
    from handeye.agents.bench_task import bench_task, bench_tasks

    chosen = [*bench_tasks().values()] if task is None else [bench_task(task)]
    if show:
        for each in chosen:
            say(f"{each.name:<20} {each.file.language:<6} {each.file.tier:<9} {each.file.title}")
        return 0
    given = [command is not None, solutions is not None, attempt is not None, brief is not None, check]
    if given.count(True) != 1:
        raise BadArgument(
            "give one of --command, --solutions, --try, --brief and --check; `handeye bench agents --list` lists the "
            "tasks"
        )
    if brief is not None:
        return _lay_out(chosen, brief)
    if check:
        return _check(chosen, json=json)
    if attempt is not None:
        return _try(chosen, attempt, feedback or "errors")
    positive(rounds, "round")
    if solutions is not None and not solutions.is_dir():
        raise BadArgument(f"{solutions}: there is no such folder")
    if page is not None:
        check_place(page, PAGE, overwrite=overwrite)
    entrant = (
        None if command is None else Entrant(command=command, rounds=rounds, feedback=feedback or "verdict")
    )
    with TemporaryDirectory() as aside:
        scores = _scores(chosen, entrant, solutions or out or Path(aside), hidden)
    result = BenchResult(
        entrant=command or str(solutions), feedback=feedback or "verdict" if rounds > 1 else "none",
        seeds="public" if hidden is None else "hidden", tasks=tuple(scores),
    )  # fmt: skip
    if page is not None:
        write_over(page, bench_page(result), PAGE)
    if json:
        put(to_json(result))
    else:
        _show(result)
    return 3 if any(each.silent for each in scores) else 0


def _lay_out(chosen: "list[BenchTask]", folder: Path) -> int:
    """Put the brief and the given files of tasks into a new folder."""
    from handeye.agents.bench_entrant import lay_out

    for task in chosen:
        place = folder if len(chosen) == 1 else folder / task.name
        say(f"{place}: {', '.join(lay_out(task, place))}")
    return 0


def _try(chosen: "list[BenchTask]", folder: Path, kind: 'Literal["verdict", "errors", "trace"]') -> int:
    """Judge one program in the public worlds, and print the feedback."""
    from handeye.agents.bench_entrant import verdicts
    from handeye.agents.bench_feedback import feedback
    from handeye.agents.call import Call

    if len(chosen) != 1:
        raise BadArgument("--try needs the name of one task")
    if not folder.is_dir():
        raise BadArgument(f"{folder}: there is no such folder")
    found = verdicts(chosen[0], folder, chosen[0].file.public, Call())
    put(feedback(found, kind).encode())
    return 3 if any(each.outcome == "silent" for each in found) else 0


def _check(chosen: "list[BenchTask]", *, json: bool) -> int:
    """Judge the reference solution and the trivial solution of each task, and print the verdicts."""
    from rich.table import Table

    from handeye.agents.bench_check import checked
    from handeye.agents.call import Call

    found = checked(
        chosen, Call(), lambda task, kind, each: note(f"{task}, {kind}, seed {each.seed}: {each.told}")
    )
    if json:
        put_json(found)
    else:
        table = Table(box=None, pad_edge=False)
        table.add_column("task", no_wrap=True)
        for name in ("worlds", "reference", "trivial", "silent", "score", "CPU s", ""):
            table.add_column(name, justify="right")
        for each in found:
            figures = each.worlds, each.reference_accepted, each.trivial_accepted, each.trivial_silent
            score, most = f"{each.trivial_score:.2f}", f"{each.largest_cpu_s:.1f}"
            table.add_row(each.task, *map(str, figures), score, most, "" if each.right else "WRONG")
        screen.print(table)
    return 0 if all(each.right for each in found) else 1


def _scores(
    tasks: "list[BenchTask]", entrant: "Entrant | None", folder: Path, hidden: Path | None
) -> "list[TaskScore]":
    """Let the entrant solve each task, and then judge all solutions. The hidden seeds are read only after the last
    task. If their file does not exist, BadFile is raised before the first task.
    """
    from handeye.agents.bench_entrant import Effort, lost, solved, verdicts
    from handeye.agents.bench_result import scored
    from handeye.agents.call import Call
    from handeye.agents.hidden_seeds import read_hidden

    efforts = {}
    if hidden is not None and not hidden.is_file():
        raise BadFile(f"{hidden}: there is no such file")
    for task in tasks:
        note(f"{task.name}: {task.file.title}")
        place = folder / task.name
        efforts[task.name] = Effort() if entrant is None else solved(task, entrant, place, Call())
    seeds = None if hidden is None else read_hidden(hidden)
    scores = []
    for task in tasks:
        effort, file = efforts[task.name], task.file
        chosen, tell = _seeds(task, seeds), partial(_tell, task.name)
        found = (
            lost(task, chosen, effort.barred, tell)
            if effort.barred
            else verdicts(task, folder / task.name, chosen, Call(), tell)
        )
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
    """The seeds of the worlds in which a task is judged. Raises BadArgument if the file of hidden seeds has no seeds
    for the task.
    """
    if hidden is None or task.file.orders:
        return task.file.public
    if not hidden.seeds.get(task.name):
        raise BadArgument(f"the file of hidden seeds has no seeds for the task {task.name}")
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
