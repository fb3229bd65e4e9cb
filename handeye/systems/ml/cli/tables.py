"""The command that shows the tables of a machine as they were in a given cycle."""

import re
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import Json, answer, note
from handeye.cli.trace_files import run_or_newest
from handeye.core.diagnostics import alternatives, names_sentence, quoted
from handeye.core.errors import BadArgument, BadFile, NoSuchName
from handeye.core.plain_text import counted
from handeye.systems.ml.level import Side

if TYPE_CHECKING:
    from handeye.systems.ml.dashboard.history import History

ENDINGS: Final = (".ml",)
_AT: Final = re.compile(r"(\d{1,9})|(\d{1,7}(?:\.\d{0,2})?|\.\d{1,2})s")


def tables(
    file: Annotated[
        Path | None,
        Parameter(
            help="The folder of a run, or a program in ML (.ml), which this command first runs on perfect motors. "
            "Default: the newest run in the folder `runs`."
        ),
    ] = None,
    table: Annotated[
        str | None, Parameter(help="A table, such as MT or ST. Default: list all tables.")
    ] = None,
    line: Annotated[int | None, Parameter(help="A line of the table: in MT a motor, in ST a sensor.")] = None,
    word: Annotated[
        int | None, Parameter(help="A word of the line. Its changes during the whole run are listed.")
    ] = None,
    /,
    *,
    at: Annotated[
        str | None,
        Parameter(
            help="Show the tables as they were at the end of this cycle (275), or of the cycle at this time (2.75s). "
            "Default: after the last cycle."
        ),
    ] = None,
    arm: Annotated[Side | None, Parameter(help="The arm, if there are two. Default: the right one.")] = None,
    sense: Annotated[
        list[str] | None,
        Parameter(
            help="Reading of a sensor, or state of an interlock, while a program runs; written as for `handeye ml "
            "run`."
        ),
    ] = None,
    json: Json = False,
) -> int:
    """Show the tables of MOS as they were in a cycle of your choice.

    Everything that MOS knows is in 30 tables. MT has a line for each motor, and ST has one for each sensor; VR has the
    variables, and TK has the program. Every ML run records each word that changes, cycle by cycle. An asterisk marks a
    word that changed in the cycle that is shown. `handeye report` shows the same tables in a page.

        handeye ml tables plans/guarded_move.ml --sense 5=500@3:2750    # which tables are there, and which change?
        handeye ml tables plans/guarded_move.ml MT --at .2s             # the motors after a fifth of a second
        handeye ml tables runs/2 ST 5 11                                # when did the flag of sensor 5 come on?

    Exit code 0: shown; 2: bad input.
    """
    from handeye.systems.ml.dashboard import text

    if file is not None and file.suffix in ENDINGS and not file.is_dir():
        done = _ran(file, sense)
    else:
        if sense:
            raise BadArgument(
                "--sense applies only to a program (.ml), because this command runs nothing else"
            )
        done = _recorded(run_or_newest(file))
    cycle = _cycle(at, done)
    if table is None:
        if line is not None or arm is not None:
            raise BadArgument("a line or an arm was given without a table; name the table, too")
        return answer(text.all_tables(done, cycle), text.overview(done, cycle), json=json)
    segment = done.find(_known(table), arm or "")
    if word is None or line is None:
        return answer(
            text.one_table(done, segment, cycle, line), text.table(done, segment, cycle, line), json=json
        )
    if at is not None:
        raise BadArgument(
            "with a word, the command shows the changes of this word in the whole run; omit the word, or omit --at"
        )
    return answer(text.one_word(done, segment, line, word), text.course(done, segment, line, word), json=json)


def _known(table: str) -> str:
    """Return the name of a table in capitals. Raises NoSuchName if there is no such table."""
    from handeye.systems.ml.tables.layout import SHAPES

    if table.upper() not in SHAPES:
        near = names_sentence(alternatives(table.upper(), SHAPES)) or f"the tables are {', '.join(SHAPES)}"
        raise NoSuchName(f"there is no table {quoted(table)}; {near}")
    return table.upper()


def _cycle(at: str | None, done: "History") -> int:
    """Return the cycle that `--at` gives. Raises BadArgument if it is not a cycle of the run."""
    from handeye.systems.ml.machine.spec import CYCLES_PER_SECOND

    if at is None:
        return done.last
    match = _AT.fullmatch(at)
    if match is None:
        raise BadArgument(f"--at takes a cycle (275) or a time (2.75s), not {quoted(at)}")
    cycle = int(match[1]) if match[1] else round(float(match[2]) * CYCLES_PER_SECOND)
    if cycle >= max(done.head.cycles, 1):
        raise BadArgument(
            f"--at is after the end of the run, which has {counted(done.head.cycles, 'cycle')}, numbered from 0"
        )
    return cycle


def _recorded(run: Path) -> "History":
    """Return the tables of a run in a folder. Raises BadFile if the folder has no tables of a run."""
    from handeye.runs.folder import check_holds_run
    from handeye.systems.ml.dashboard.kept import kept_history

    check_holds_run(run)
    done = kept_history(run)
    if done is None:
        raise BadFile(
            f"the run in {run} has no tables: it is not a run of ML, or an older version of handeye wrote it without "
            "tables"
        )
    return done


def _ran(file: Path, sense: list[str] | None) -> "History":
    """Run a program on perfect motors, and return its tables. Raises InvalidInput if the program cannot be run."""
    from handeye.core.source import read_source
    from handeye.core.variation import WorldSpec
    from handeye.runs.advance import advance
    from handeye.runs.runner import Runner
    from handeye.runs.setup import Setup
    from handeye.runs.snapshot import Checkpoint
    from handeye.systems.ml.cli.senses import sensed
    from handeye.systems.ml.run.plan import MlPlan, sound
    from handeye.systems.ml.run.running import RunningMl

    stimuli = tuple(sensed(each) for each in sense or ())
    plan = MlPlan(name=file.name, text=read_source(file).text, stimuli=stimuli)
    sound(plan)
    setup = Setup(system="ml", plan=plan, world=WorldSpec(seed=0), camera="auto")
    runner = Runner(Checkpoint(setup=setup))
    pause = advance(runner)
    if pause.kind == "operator":
        note(f"the program stopped: {pause.message}")
    assert isinstance(runner.system, RunningMl)
    return runner.system.tables
