"""The command that finds a planted fault of SUPERSIGMA, or lets a player find the fault."""

import sys
from typing import Annotated

from cyclopts import Parameter

from handeye.cli.common import Json, WholeNumber, say
from handeye.core.errors import BadArgument, InvalidInput
from handeye.systems.sigma.cli.studies import put_study


def diagnose(
    *,
    fault: Annotated[
        str | None, Parameter(help="Plant this fault and find it; `--all` prints the names of all faults.")
    ] = None,
    every: Annotated[
        bool, Parameter(name="--all", negative=(), help="Plant and find each of the twenty faults.")
    ] = False,
    game: Annotated[
        bool, Parameter(negative=(), help="Find a planted fault yourself: type tests, then accuse a part.")
    ] = False,
    demo: Annotated[
        bool,
        Parameter(
            negative=(),
            help="Let handeye play the game, with the tests in the order of the paper. `--seed` chooses the fault.",
        ),
    ] = False,
    seed: Annotated[
        WholeNumber | None,
        Parameter(
            help="Seed of the world. In a game, the seed determines the fault (default: 0). With --fault or --all, "
            "the seed determines the place of each fault; without --seed, each fault is at its usual place."
        ),
    ] = None,
    json: Json = False,
) -> int:
    """Find the faulty part of SUPERSIGMA. The tests begin with the computer, and go on with the bus, the
    microcomputers, the transducers and the drives.

    Without options, the tests run on a sound machine.

    Exit code 0: the part was found, or the machine is sound; with `--all`, at least 17 parts were found and none was
    wrongly accused; 1: anything else; 2: bad input.
    """
    if sum((fault is not None, every, game or demo)) > 1:
        raise BadArgument("--fault, --all and --game exclude each other")
    if game or demo:
        if json:
            raise BadArgument("--json does not apply to a game")
        return _play(seed or 0, demo=demo)
    from handeye.systems.sigma.diagnosis import report
    from handeye.systems.sigma.diagnosis.bench import Bench
    from handeye.systems.sigma.diagnosis.faults import planted
    from handeye.systems.sigma.diagnosis.strategy import Strategy

    if every:
        found = report.all_diagnosed(seed)
        if json:
            figures = {"found": sum(each.right for each in found), "faults": found}
            good, told = report.good(found), report.told(found)
            put_study("diagnose", figures, completed=good, message=told, seed=seed)
        else:
            for line in report.lines(found):
                say(line, whole=True)
        return 0 if report.good(found) else 1
    there = None if fault is None else planted(fault, seed)
    steps: list[dict[str, object]] = []

    def tell(typed: str, lines: object) -> None:
        steps.append({"test": typed, "lines": lines})
        if not json:
            say(f"> {typed}")
            for line in lines if isinstance(lines, list | tuple) else ():
                say(line)

    verdict = Strategy(Bench(there, seed or 0), tell).diagnose()
    right = verdict.part == ("" if there is None else there.part)
    if json:
        figures = {"planted": there, "verdict": verdict, "tests": steps}
        put_study("diagnose", figures, completed=right, message=verdict.why, seed=seed)
    else:
        say("")
        if there is not None:
            say(f"Planted: {there.told}.")
        say(
            f"Found: {verdict.part}: {verdict.why}."
            if verdict.part
            else f"No faulty part was found: {verdict.why}."
        )
    return 0 if right else 1


def _play(seed: int, *, demo: bool) -> int:
    from handeye.cli.panic_button import PanicButton
    from handeye.cli.prompt import typed_lines
    from handeye.execution.servo import Halted
    from handeye.systems.sigma.diagnosis.game import Game, demonstrate

    terminal = sys.stdin.isatty()
    with PanicButton() as panic:

        def poll() -> None:
            if panic():
                raise Halted

        session = Game(say, seed, poll)
        session.begin()
        if demo:
            demonstrate(session, say)
            return 0 if session.won else 1
        for line in typed_lines("> " if terminal else "", panic.aside, session.words):
            try:
                session.hear(line)
            except InvalidInput as error:
                say(str(error))
                if not terminal:
                    return 2
            if session.over:
                break
    return 0 if session.won else 1
