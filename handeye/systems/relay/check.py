"""Checks whether the legs of a relay fit together, and finds the operations for which the language of a leg has no
words.
"""

from collections.abc import Iterator
from functools import lru_cache
from typing import Literal

from handeye.core.entries import entry_named
from handeye.core.errors import BadFile
from handeye.core.record import Record
from handeye.program.motion_operations import Move
from handeye.program.operation import Operation
from handeye.program.program import Program
from handeye.runs.hand_over import Kind
from handeye.systems.relay.plan import Leg, RelayPlan, legs
from handeye.tasks import task

Trouble = Literal["error", "cannot-express"]


class LegFinding(Record, frozen=True, kw_only=True):
    """What is wrong with a leg, or what its language cannot express."""

    kind: Trouble
    stage: str
    system: str
    file: str  # that has the line
    line: int
    sentence: str

    @property
    def told(self) -> str:
        return f"{self.stage}: {self.file}, line {self.line}: {self.sentence}"


def check_plan(plan: RelayPlan) -> None:
    """Raise BadFile if the legs do not fit together."""
    first = next(misfits(plan), None)
    if first is not None:
        raise BadFile(f"the leg {first.told}")


def misfits(plan: RelayPlan) -> Iterator[LegFinding]:
    """Yield what prevents the legs from running one after the other."""
    known: set[tuple[str, Kind]] = set()
    earlier: dict[str, list[str]] = {}
    eye = legs(plan)[0].system.takes_pictures(legs(plan)[0].plan)
    for leg in legs(plan):

        def found(line: int, sentence: str, leg: Leg = leg) -> LegFinding:
            return LegFinding(
                kind="error",
                stage=leg.stage,
                system=leg.system.system,
                file=leg.file,
                line=line,
                sentence=sentence,
            )

        for use in leg.system.reads(leg.plan, leg.stage):
            if (use.name, use.kind) not in known:
                yield found(use.line, f"no earlier leg finds the {use.kind} {use.name}")
        for lack in leg.system.lacks(leg.plan, leg.stage, earlier.get(leg.file, [])):
            yield found(lack.line, lack.sentence)
        if leg.system.takes_pictures(leg.plan) and not eye:
            yield found(
                1,
                "the program takes pictures, but the camera is not calibrated, because the program of the first "
                "leg takes no pictures",
            )
        found_here = leg.system.writes(leg.plan, leg.stage)
        known |= {(use.name, use.kind) for use in found_here}
        known |= {(use.name, "height") for use in found_here if use.kind == "place"}
        earlier.setdefault(leg.file, []).append(leg.stage)


def inexpressible(plan: RelayPlan) -> Iterator[LegFinding]:
    """For each leg, look up the stage with the same name in the task's own program. Yield the lines of this stage that
    the language of the leg cannot express.
    """
    program, file = own_program(plan.task)
    for leg in legs(plan):
        if leg.system.words is None or leg.stage not in program.stages:
            continue
        stage = program.stages.index(leg.stage)
        for step in program.steps:
            if step.stage == stage and not demands(step.operation) <= leg.system.words:
                title = entry_named(leg.system.system).title
                yield LegFinding(
                    kind="cannot-express", stage=leg.stage, system=leg.system.system, file=step.file or file,
                    line=step.line, sentence=f"{title} has no words for {step.text.strip()}",
                )  # fmt: skip


def demands(operation: Operation) -> set[str]:
    """Return the concepts for which a language needs words: the operation, the use of saved differences in a motion
    (`Restore`), and the control of the force in a motion (`Comply`).
    """
    found = {type(operation).__name__}
    if isinstance(operation, Move) and operation.restore:
        found.add("Restore")
    if operation.complies or operation.press is not None:
        found.add("Comply")
    return found


@lru_cache(maxsize=2)
def own_program(name: str) -> tuple[Program, str]:
    """Return the checked program of a task, and the name of its file."""
    from handeye.al import AL
    from handeye.runs.scripts import default_script, taught

    file = default_script(task(name))
    program, _ = AL.compile(AL.read(file), taught(file))
    if program is None:
        raise BadFile(f"{file} has errors")
    return program, file.name
