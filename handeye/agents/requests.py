"""The arguments of each tool as records. The schema that a client sees is made from the types of these records. Each
call is checked against the same types.
"""

from typing import Annotated, Any, Final, Literal, TypeVar

import msgspec
from msgspec import Meta

from handeye.core.errors import BadArgument
from handeye.core.variation import LARGEST_SEED, Level
from handeye.program.taught import unfit

MOST_WORLDS: Final = 20  # of one submission

Script = Annotated[
    str,
    Meta(
        min_length=1,
        max_length=500_000,
        description="The text of a script (it must contain a line break); or the name of a file in the agent's "
        "folder (pin.al); or the name of an included program (insertion, water_pump).",
    ),
]
TaughtPositions = Annotated[
    str,
    Meta(
        max_length=500_000,
        description="Taught positions (inches, degrees). A value with a line break is the text of a TOML file. A "
        "value without a line break is the name of a file in the folder, or the name of an included program whose "
        "positions are used. Default: the .toml file next to the script, if there is one.",
    ),
]
TaskName = Annotated[
    str,
    Meta(max_length=100, description=(
        "Name of the task, such as insertion. Default: water_pump or, if `script` is the name of an included "
        "program, the task of this program."
    )),
]  # fmt: skip
RunName = Annotated[
    str,
    Meta(max_length=100, description="Name of a run, such as run-1. Default: the run that was used last."),
]
SeedNumber = Annotated[int, Meta(ge=0, le=LARGEST_SEED, description="Seed of the world.")]
Count = Annotated[int, Meta(ge=1, le=1_000_000)]


class Request(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """The arguments of a call."""


class Docs(Request, frozen=True, kw_only=True):
    """Arguments of `docs`."""

    topic: Annotated[
        str,
        Meta(
            max_length=200,
            description="A page (tutorial, language, search), or an included file (insertion.al, insertion.toml). "
            "Default: the index.",
        ),
    ] = ""


class Explain(Request, frozen=True, kw_only=True):
    """Arguments of `explain`."""

    word: Annotated[
        str,
        Meta(max_length=200, description="A diagnostic code (label-twice), an error number (23) or an instruction "
             "(CHANGE). Default: list all of these."),
    ] = ""  # fmt: skip


class Check(Request, frozen=True, kw_only=True):
    """Arguments of `check`."""

    script: Script
    taught: TaughtPositions | None = None
    task: TaskName | None = None
    language: Annotated[
        str,
        Meta(
            max_length=20,
            description="Language of a script that is given as text. Give the ending of the language's file names, "
            "such as al or ml. If the script is a file, its own name gives the language.",
        ),
    ] = "al"


class PlanOf(Request, frozen=True, kw_only=True):
    """Arguments of `plan`."""

    script: Script
    taught: TaughtPositions | None = None
    task: TaskName | None = None
    stage: (
        Annotated[
            int,
            Meta(
                ge=1,
                le=1000,
                description="List the steps of the stage with this number. Default: list only the stages.",
            ),
        ]
        | None
    ) = None


class WorldOf(Request, frozen=True, kw_only=True):
    """Arguments of `world`."""

    task: TaskName | None = None
    group: Annotated[
        str,
        Meta(
            max_length=200,
            description="List only the quantities whose names begin with this text, such as arm.offset.",
        ),
    ] = ""
    level: Level = "nominal"


class Advance(Request, frozen=True, kw_only=True):
    """Arguments of `run`."""

    script: Script | None = None
    taught: TaughtPositions | None = None
    task: TaskName | None = None
    run: RunName | None = None
    seed: SeedNumber = 0
    level: Level = "nominal"
    set: dict[str, float | str] = {}
    without: list[str] = []
    faults: list[str] = []
    until: Annotated[
        str,
        Meta(
            max_length=200,
            description="Where to pause: a stage, a label, a line, an instruction (AOJ), or error:23. Default: run to "
            "the end.",
        ),
    ] = ""
    steps: (
        Annotated[
            int,
            Meta(ge=0, le=1_000_000, description="Pause after this number of steps; 0 only begins the run."),
        ]
        | None
    ) = None
    answer: Annotated[
        Literal["retry", "proceed", "skip"] | None,
        Meta(
            description="Give this answer when the program has called the operator, and then continue the run."
        ),
    ] = None


class StateOf(Request, frozen=True, kw_only=True):
    """Arguments of `state`."""

    run: RunName | None = None
    show: Annotated[
        str, Meta(max_length=200, description="Topics, such as `force gap`. Default: all of them.")
    ] = ""


class PictureOf(Request, frozen=True, kw_only=True):
    """Arguments of `picture`."""

    run: RunName | None = None


class Back(Request, frozen=True, kw_only=True):
    """Arguments of `back`."""

    run: RunName | None = None
    steps: Count = 1
    stage: Annotated[
        str,
        Meta(
            max_length=200,
            description="Go back to the beginning of this stage. If no stage is given, the run goes back by `steps` "
            "steps.",
        ),
    ] = ""


class Fork(Request, frozen=True, kw_only=True):
    """Arguments of `fork`."""

    run: RunName | None = None
    to: Annotated[str, Meta(max_length=100, description="Name of the new run.")] | None = None
    stage: Annotated[
        str,
        Meta(
            max_length=200,
            description=(
                "The new run begins with this stage. Default: it begins at the present state of the existing run."
            ),
        ),
    ] = ""


class ResultOf(Request, frozen=True, kw_only=True):
    """Arguments of `result`."""

    run: RunName | None = None


class Submit(Request, frozen=True, kw_only=True):
    """Arguments of `submit`."""

    script: Script
    taught: TaughtPositions | None = None
    task: TaskName | None = None
    worlds: Annotated[int, Meta(ge=1, le=MOST_WORLDS, description="Number of worlds.")] = 3
    seed: SeedNumber = 0
    level: Level = "nominal"


AnyRequest = TypeVar("AnyRequest", bound=Request)


def read(tool: str, kind: type[AnyRequest], arguments: object) -> AnyRequest:
    """Check the arguments of a call of the tool `tool`. If an argument is wrong, raises BadArgument, which names this
    argument.
    """
    try:
        return msgspec.convert({} if arguments is None else arguments, kind, strict=True)
    except msgspec.ValidationError as error:
        raise BadArgument(f"the arguments of `{tool}` cannot be used: {unfit(error)}") from None


def schema(kind: type[Request]) -> dict[str, Any]:
    """Return the JSON schema of the arguments of a tool."""
    _, parts = msgspec.json.schema_components([kind])
    found = dict(parts[kind.__name__])
    found.pop("title", None)
    found.pop("description", None)
    return found
