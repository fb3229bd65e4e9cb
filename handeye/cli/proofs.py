"""`handeye check --prove`: proves that the steps on every path to the end of a program show that the work is right."""

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final

import msgspec
from cyclopts import Group, Parameter

from handeye.cli.common import Overwrite, put_json, say, show
from handeye.cli.drawings import Drawing, write_drawing
from handeye.cli.programs import plan_at
from handeye.core.diagnostics import as_json, quoted
from handeye.core.entries import entry_of_file
from handeye.core.errors import BadArgument, Refused
from handeye.core.variation import WorldSpec
from handeye.core.world_options import overrides

if TYPE_CHECKING:
    from handeye.planfile.plan import Plan
    from handeye.proof.proof import Proof

PROOF: Final = Group("Proof", sort_key=1)


@Parameter(name="*", group=PROOF)
@dataclass(frozen=True, slots=True, kw_only=True)
class ProofOptions:
    """Options that `--prove` needs."""

    graph: Annotated[
        Drawing | None, Parameter(help="With --prove: draw the proof instead of printing it.")
    ] = None
    output: Annotated[
        Path | None,
        Parameter(name=["--out", "-o"], help="File for the drawing. Default: standard output."),
    ] = None
    overwrite: Overwrite = False
    settings: Annotated[
        list[str] | None,
        Parameter(
            name="--set",
            help="NAME=VALUE: with --prove, a quantity that changes the job, such as pump.screws=7. May be repeated.",
            consume_multiple=False,
        ),
    ] = None

    def refuse_without_prove(self) -> None:
        """Raise BadArgument if any of the options is given."""
        if self != ProofOptions():
            raise BadArgument("--graph, --out, --overwrite and --set need --prove")


def refuse_with_prove(*, strict: bool, watch: bool) -> None:
    """Raise BadArgument if the user asks for a proof and also for another check, `--strict-1973` or `--watch`."""
    if strict or watch:
        raise BadArgument(f"--prove and {'--strict-1973' if strict else '--watch'} cannot be given together")


def proved(file: Path, task_words: str | None, options: ProofOptions, *, json: bool) -> int:
    """Prove the obligations of the task of a script or plan. Returns the exit code: 0 if all obligations are shown on
    every path to the end, 2 if not.
    """
    from handeye.proof.argument import argument, unproved

    if options.graph is not None and json:
        raise BadArgument("--graph and --json cannot be given together")
    if options.output is not None and options.graph is None:
        raise BadArgument("--out needs --graph svg or --graph dot")
    entry, _ = entry_of_file(file.name)
    if entry is not None:
        raise Refused(
            f"{file} is a program of {entry.title}; --prove works only for programs that are planned"
        )
    plan = plan_at(file, task_words)
    proof = _proof(plan, options.settings or [])
    found = unproved(proof, plan.program)
    if options.graph is not None:
        from handeye.proof.drawing import proof_flow

        write_drawing(proof_flow(proof, plan), options.graph, options.output, overwrite=options.overwrite)
    elif json:
        put_json(
            {
                "proof": msgspec.to_builtins(proof),
                "diagnostics": [as_json(each, plan.program.whole) for each in found],
            }
        )
    else:
        show(found, plan.program.whole, json=False)
        for paragraph in argument(proof, plan.program):
            say(paragraph)
    return 0 if proof.holds else 2


def _proof(plan: "Plan", settings: list[str]) -> "Proof":
    from handeye.proof.proof import prove
    from handeye.tasks import named, planned

    work = planned(named(plan.task))
    variation = work.variation()
    world = WorldSpec(seed=0, overrides=overrides(variation, [], settings))
    variation.check(world)
    obligations = work.obligations(world)
    if not obligations:
        raise Refused(f"the task {quoted(work.name)} declares no obligations, so there is nothing to prove")
    return prove(plan.program, obligations, plan.task)
