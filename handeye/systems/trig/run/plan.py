"""The plan of a taught job is its script. The steps are the same in every world, but the places differ."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import zip_longest
from typing import ClassVar, Final

import msgspec

from handeye.core.diagnostics import quoted
from handeye.core.errors import BadFile, InvalidInput, Refused
from handeye.program.operation import Device
from handeye.systems.trig.jobs.benches import TaughtPlan, new_session, read_taught_plan
from handeye.systems.trig.language.command_input import LineRefused, Script, type_script
from handeye.systems.trig.language.display import Cell, loop_words, step_words
from handeye.systems.trig.language.graph import NONE, Graph, Node
from handeye.systems.trig.language.program import TrigProgram
from handeye.systems.trig.language.styled import ASCII

PATIENCE: Final = 100_000  # number of halt checks after which a program run during teaching counts as endless


@dataclass(frozen=True, slots=True, kw_only=True)
class TaughtStep:
    """A step in the listing of a program."""

    node: int
    line: int
    text: str
    word: str
    label: str
    ways: tuple[int | None, ...]
    stage: ClassVar[int] = 0
    file: ClassVar[str] = ""
    macro: ClassVar[str] = ""
    examines: ClassVar[None] = None
    guarded: ClassVar[bool] = False
    begins_search: ClassVar[bool] = False

    @property
    def needs(self) -> Device | None:
        """The device that the step needs: `hand` if the step only opens or closes the hand, or else None."""
        return "hand" if self.word in ("grasp", "ungrasp") else None

    @property
    def place(self) -> str:
        return str(self.line)


@dataclass(frozen=True, slots=True, kw_only=True)
class TaughtListing:
    """The steps of a program in drawing order, one step per line."""

    name: str
    steps: Sequence[TaughtStep]
    stages: tuple[str, ...]
    required: ClassVar[dict[str, str]] = {}
    numbered: ClassVar[Mapping[int, str]] = {}
    errors: ClassVar[tuple[int, ...]] = ()

    @property
    def numbers(self) -> Mapping[int, int]:
        return {step.node: number for number, step in enumerate(self.steps)}

    @property
    def source(self) -> str:
        return "\n".join(step.text for step in self.steps)

    @property
    def labels(self) -> Mapping[str, Sequence[int]]:
        return {step.label: (number,) for number, step in enumerate(self.steps) if step.label}


def encode(plan: TaughtPlan) -> bytes:
    return msgspec.json.format(msgspec.json.encode(plan), indent=1) + b"\n"


def decode(data: bytes, name: str) -> TaughtPlan:
    """Decode and check a plan. Raises BadFile if the plan is not valid."""
    plan = read_taught_plan(data, name)
    try:
        listing(plan)
    except InvalidInput as error:
        raise BadFile(f"{name} is not valid: {error}") from None
    return plan


def imagined(plan: TaughtPlan) -> TrigProgram:
    """Return the program that results if a plan's script is taught to an imaginary arm. Raises LineRefused if a line
    of the script cannot be executed.
    """
    return typed(plan.script, f"{plan.job}.trig")


def typed(text: str, name: str) -> TrigProgram:
    """Return the program that a script teaches on an imaginary arm. The steps of the program are the same in every
    world, but the places are not. Raises LineRefused if a line of the script cannot be executed.
    """
    session, asked = new_session("none"), 0

    def ask() -> bool:
        nonlocal asked
        asked += 1
        if asked > PATIENCE:
            raise Refused("a RUN in the script does not end")
        return False

    script = Script(text.splitlines(), halted=ask)
    session.desk, session.files = script, False  # checkpoints and traces of any origin contain a plan
    try:
        type_script(session, script, name)
    except LineRefused as refused:
        raise refused.on("the ideal arm") from None
    return session.program


@lru_cache(maxsize=4)
def listing(plan: TaughtPlan) -> TaughtListing:
    return TaughtListing(name=plan.job, steps=steps_of(imagined(plan)), stages=(plan.job,))


def steps_of(program: TrigProgram) -> tuple[TaughtStep, ...]:
    """Return the steps of a program in drawing order."""
    steps = [*program.graph.steps()]
    numbers = {node.id: number for number, node in enumerate(steps)}
    return tuple(_step(program, node, numbers) for node in steps)


def told_difference(planned: Sequence[TaughtStep], taught: Sequence[TaughtStep]) -> str:
    """Say where the steps that a script has taught in a world differ from the planned steps."""
    first = next(one or other for one, other in zip_longest(planned, taught) if one != other)
    assert first is not None
    return (
        "in this world, the script teaches steps that differ from the steps of the plan, which the script taught "
        f"on the ideal arm; the first difference is at step {first.line}, {quoted(first.text)}, or in the branches "
        "of this step"
    )


def _step(program: TrigProgram, node: Node, numbers: Mapping[int, int]) -> TaughtStep:
    graph, number = program.graph, numbers[node.id]
    return TaughtStep(
        node=node.id,
        line=number + 1,
        text=_text(program, node, number),
        word=node.type,
        label=node.name or "",
        ways=tuple(_ways(graph, node, numbers)),
    )


def _text(program: TrigProgram, node: Node, number: int) -> str:
    """Return the text of a step, without the counts of loops."""
    if node.type == "loop":
        return loop_words(program.graph, node, ASCII)
    shown, deed, _ = step_words(
        program.graph, program.positions, Cell(row=number, column=0, node=node), ASCII
    )
    return " ".join(filter(None, (shown if node.name or not deed else "", deed)))


def text_now(step: TaughtStep, node: Node) -> str:
    """Return the present text of a step. The text of a loop includes the number of the present round."""
    if node.type != "loop":
        return step.text
    back = f"goes back ({node.count + 1} of {node.wanted})" if node.count < node.wanted else "goes on"
    return f"{step.text}, {back}"


def _ways(graph: Graph, node: Node, numbers: Mapping[int, int]) -> list[int | None]:
    """Return the numbers of the steps that may follow a step, with None for the end."""
    sons = [graph.step_at(son) for son in node.sons]
    target = graph.target(node) if node.type == "loop" else None
    return [
        *(None if son == NONE else numbers[son] for son in sons),
        *([numbers[target.id]] if target else []),
    ]
