"""`handeye exercise`: the exercises of the course, and the grade of a student's program."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

from cyclopts import Parameter

from handeye.cli.common import Json, Overwrite, WholeNumber, positive, put_json, say, show
from handeye.cli.tally import Tally
from handeye.core.diagnostics import as_json, has_errors, quoted, suggestion
from handeye.core.errors import BadArgument, NoSuchName, Taken
from handeye.core.files import beside, is_there, write_whole
from handeye.core.plain_text import counted
from handeye.core.source import read_source

if TYPE_CHECKING:
    from handeye.exercises.exercise import Exercise, Grade

TAUGHT: Final = ".toml"


def exercise(
    name: Annotated[str | None, Parameter(help="Name of an exercise. Default: list the exercises.")] = None,
    file: Annotated[Path | None, Parameter(help="Your program. Default: show what to do.")] = None,
    /,
    *,
    start: Annotated[
        bool,
        Parameter(
            help="Write the exercise's starting program and its taught positions into the current folder."
        ),
    ] = False,
    overwrite: Overwrite = False,
    seed: Annotated[
        WholeNumber | None, Parameter(help="Try your program only in the world with this seed.")
    ] = None,
    first_seed: Annotated[
        WholeNumber | None,
        Parameter(
            help="Try your program in other worlds than those of the exercise, but in the same number of worlds. "
            "--first-seed gives the seed of the first of these worlds; each further world has the next seed. "
            "Default: the worlds of the exercise."
        ),
    ] = None,
    jobs: Annotated[WholeNumber, Parameter(help="Number of processes that work at the same time.")] = 2,
    json: Json = False,
) -> int:
    """List the exercises of the course, show one of them, or grade a program. A grade says in which worlds the program
    is right, and gives hints.

    ```
    handeye exercise
    handeye exercise find --start
    handeye exercise find find.al
    handeye exercise find find.al --first-seed 1000
    ```

    Exit code 0: the program is right in every world; 1: in at least one world, the program is not right; 3: a silent
    failure: in at least one world, the program reported success but its work is wrong; 2: bad input, or a program with
    mistakes.
    """
    from handeye.exercises import exercises

    known = exercises()
    if name is None:
        return _list(known, json=json)
    if name not in known:
        near = suggestion(name, known) or "`handeye exercise` lists them"
        raise NoSuchName(f"there is no exercise {quoted(name)}; {near}")
    chosen = known[name]
    positive(jobs, "process")
    if start and (file is not None or seed is not None or first_seed is not None):
        raise BadArgument("--start writes the program of the exercise; leave out your file and all seeds")
    if start:
        return _begin(chosen, overwrite=overwrite, json=json)
    if file is None:
        if seed is not None or first_seed is not None:
            raise BadArgument(
                f"{'--first-seed' if seed is None else '--seed'} needs the file of your program"
            )
        return _describe(chosen, json=json)
    if first_seed is not None:
        chosen = _elsewhere(chosen, first_seed)
    return _grade(chosen, file, seed, jobs, json=json)


def _list(known: "Mapping[str, Exercise]", *, json: bool) -> int:
    rows = [{"name": each.name, "session": each.session, "title": each.title} for each in known.values()]
    if json:
        put_json(rows)
        return 0
    wide = max(map(len, known))
    for each in known.values():
        say(f"session {each.session}  {each.name:{wide}}  {each.title}")
    say("\n`handeye exercise NAME` shows an exercise, and `handeye exercise NAME FILE` grades your program.")
    return 0


def _describe(chosen: "Exercise", *, json: bool) -> int:
    if json:
        put_json(
            {
                "name": chosen.name,
                "session": chosen.session,
                "title": chosen.title,
                "brief": chosen.brief,
                "rules": chosen.rules,
                "cases": chosen.cases,
                "seeds": chosen.seeds,
                "start": chosen.start,
            }
        )
        return 0
    say(f"{chosen.name}: {chosen.title}\n")
    say(f"{chosen.brief}\n")
    for rule in chosen.rules:
        say(f"- {rule}")
    say(f"\nYour program is judged in {chosen.cases}.\n")
    say(f"begin   handeye exercise {chosen.name} --start", whole=True)
    say(f"submit  handeye exercise {chosen.name} {chosen.start}", whole=True)
    return 0


def _begin(chosen: "Exercise", *, overwrite: bool, json: bool) -> int:
    """Write the program from which a student starts, and its taught positions, if any. Nothing is written if the file
    of the program or of the positions already exists, unless `overwrite` is True.
    """
    program = Path(chosen.start)
    files = {program: chosen.program.text}
    if chosen.positions is not None:
        files[program.with_suffix(TAUGHT)] = chosen.positions.text
    taken = [file for file in files if is_there(file)]
    if taken and not overwrite:
        raise Taken(f"{taken[0]} already exists; nothing was written. --overwrite replaces it")
    for file, text in files.items():
        write_whole(file, text.encode())
    if json:
        put_json({"exercise": chosen.name, "files": [str(file) for file in files]})
    else:
        say(f"wrote {' and '.join(map(str, files))}")
    return 0


def _grade(chosen: "Exercise", file: Path, seed: int | None, jobs: int, *, json: bool) -> int:
    from handeye.exercises.exercise import Grade, Submission

    if seed is not None and seed not in chosen.seeds:
        raise BadArgument(_no_such_seed(chosen, seed))
    source, beside_it = chosen.read(file), beside(file, TAUGHT)
    taught = read_source(beside_it) if chosen.positions is not None and is_there(beside_it) else None
    seeds = chosen.seeds if seed is None else (seed,)
    with Tally(max(1, len(seeds)), "cases") as progress:
        given = Submission(
            source=source, taught=taught, seeds=seeds, jobs=jobs, told=lambda _: progress.one_more()
        )
        mistakes = chosen.diagnostics(given)
        wrong = has_errors(mistakes)
        found = Grade(exercise=chosen.name, verdicts=()) if wrong else chosen.grade(given)
    code = 2 if wrong else found.exit_code
    if json:
        put_json(_as_json(found, code, [as_json(each, source) for each in mistakes]))
        return code
    show(mistakes, source, json=False)
    if wrong:
        first = next(each for each in mistakes if each.severity == "error")
        say(f"{file} has mistakes, so it was not run. `handeye explain {first.code}` explains the first one.")
    else:
        _tell(found)
    return code


def _elsewhere(chosen: "Exercise", first: int) -> "Exercise":
    """Return the exercise with other worlds, whose smallest seed is `first`. Raises BadArgument if the exercise has no
    worlds, or if a seed is not valid.
    """
    from handeye.core.variation import checked_seed

    if not chosen.seeds:
        raise BadArgument(f"the exercise {chosen.name} has no worlds, so --first-seed does not apply")
    moved = chosen.beginning_at(first)
    for seed in (moved.seeds[0], moved.seeds[-1]):
        checked_seed(seed)
    return moved


def _no_such_seed(chosen: "Exercise", seed: int) -> str:
    if not chosen.seeds:
        return f"the exercise {chosen.name} has no worlds, so --seed does not apply"
    return f"the exercise {chosen.name} has no world {seed}; its seeds are {chosen.seeds[0]} to {chosen.seeds[-1]}"


def _as_json(found: "Grade", code: int, diagnostics: list[dict[str, object]]) -> dict[str, object]:
    return {
        "exercise": found.exercise,
        "exit_code": code,
        "right": found.right,
        "of": len(found.verdicts),
        "silent": found.silent,
        "verdicts": found.verdicts,
        "hints": found.hints,
        "diagnostics": diagnostics,
    }


def _tell(found: "Grade") -> None:
    """Print the grade, silent failures first."""
    if len(found.verdicts) > 1:
        say(f"{found.exercise}: right in {found.right} of {counted(len(found.verdicts), 'case')}")
    elif found.right:
        say(f"{found.exercise}: right in {found.verdicts[0].case}")
    else:
        say(f"{found.exercise}: not right")
    if not found.failures:
        return
    for outcome, failures in found.by_outcome.items():
        silent = "SILENT: " if failures[0].standing == "silent" else ""
        say(f"  {silent}{outcome}: {', '.join(each.case for each in failures)}")
    first = found.failures[0]
    say(f"first failure, {first.case}: {first.reason}")
    if first.again:
        say("repeat it:")
        say(f"  {first.again}", whole=True)
    for hint in found.hints:
        say(f"hint: {hint}")
