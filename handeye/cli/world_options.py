"""Options that choose a world. Every command that builds a world has these options."""

from collections.abc import Set
from dataclasses import dataclass, replace
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Final, Literal, Self

import msgspec
from cyclopts import Group, Parameter

from handeye.cli.common import TaskWords, whole
from handeye.core.diagnostics import quoted
from handeye.core.errors import BadArgument, BadFile, InvalidInput
from handeye.core.variation import WorldSpec, checked_seed
from handeye.core.world_file import read_world
from handeye.core.world_options import StageNumber, faults, from_start_only, overrides
from handeye.program.senses import SENSES
from handeye.tasks import DEFAULT, any_task, named, option

if TYPE_CHECKING:
    from handeye.runs.system import Listing
    from handeye.tasks.interface import AnyTask

WORLD: Final = Group("World", sort_key=1)

Faults = Annotated[
    list[str] | None,
    Parameter(
        name="--fault",
        group=WORLD,
        consume_multiple=False,
        help="A fault: NAME or NAME=VALUE. Add @STAGE to begin the fault at that stage instead of at the start. The "
        "jobs of ML have no stages: to begin a fault of the arm at a given time, add a time, such as @30s. `handeye "
        "faults --list` lists the faults of the pump; with `--task NAME`, the command lists the faults of another "
        "task. To plant several faults, repeat --fault.",
    ),
]


@Parameter(name="*", group=WORLD)
@dataclass(frozen=True, slots=True, kw_only=True)
class ErrorOptions:
    """Options that choose the task of a world, its errors, and the sizes of the errors."""

    task: TaskWords = None
    level: Annotated[
        Literal["low", "nominal", "high"],
        Parameter(help="Size of the errors: `low` is half of `nominal`, `high` is twice `nominal`."),
    ] = "nominal"
    without: Annotated[
        list[str] | None,
        Parameter(
            help="Errors, or groups of errors, to switch off, separated by commas; `handeye world` lists their "
            "names. `assemble`, `run` and `trials assembly` also accept senses (vision, touch, search, force, "
            "centring): without a sense, the program relies on its plan. These commands also accept macros of the "
            "program, and skip them: for example HEADS, which checks the screws of the pump, and TOOLS, which "
            "checks that the screwdriver and the pins are back in their places.",
            consume_multiple=False,
        ),
    ] = None
    settings: Annotated[
        list[str] | None,
        Parameter(
            name="--set",
            help="NAME=VALUE: a value for a quantity, or for each quantity of a group, such as "
            "camera.place.x=.3in. May be repeated.",
            consume_multiple=False,
        ),
    ] = None
    scale: Annotated[
        list[str] | None,
        Parameter(
            help="NAME=FACTOR: multiply the errors of a quantity or group by a factor; unsourced=2 doubles all "
            "errors for which no source gives a size. May be repeated.",
            consume_multiple=False,
        ),
    ] = None

    @property
    def work(self) -> "AnyTask":
        """The task; raises InvalidInput if there is none."""
        return any_task(DEFAULT) if self.task is None else named(self.task)

    def of(self, name: str) -> Self:
        """A copy of these options for the task called `name`. The name comes from a plan or a run. The method imports
        no task module.
        """
        return replace(self, task=any_task(name).name)

    def spec(self, seed: int) -> WorldSpec:
        """The world of this seed, with the errors that the options choose. Raises InvalidInput if a seed, name, unit
        or value is invalid.
        """
        checked_seed(seed)
        off = self._names()
        if "" in off:
            raise BadArgument(
                "--without needs names of errors, separated by single commas; `handeye world` lists the names"
            )
        lacking = next((name for name in off if name in SENSES), None)
        if lacking is not None:
            raise BadArgument(
                f"`{lacking}` is a sense, not an error of the world; this command runs no program that could do "
                "without it"
            )
        wanted = overrides(self.work.variation(), off, self.settings or (), self.scale or ())
        spec = WorldSpec(seed=seed, level=self.level, overrides=wanted)
        self.work.variation().check(spec)
        return spec

    def check(self, seed: int) -> None:
        """Check seed, level, values and factors, before the program is planned. The names after --without are not
        checked here, because they can be macros of the program. Raises InvalidInput if an option is wrong.
        """
        replace(self, without=None).spec(seed)

    def apart(self, calls: Set[str]) -> "tuple[ErrorOptions, tuple[str, ...]]":
        """Split the names in `--without`. The first value is a copy of these options. In this copy, `--without` names
        only errors of the world. The second value names the senses and macros that the program must do without, each
        name once.
        """
        names = [name.upper() if name.upper() in calls else name for name in self._names()]
        spared = [*SENSES, *sorted(calls)]
        errors = [name for name in names if name not in spared]
        return replace(self, without=errors or None), tuple(name for name in spared if name in names)

    def _names(self) -> list[str]:
        return [name.strip() for names in self.without or () for name in names.split(",")]

    def words(self) -> list[str]:
        """The options as they are typed."""
        task = [] if self.task is None else option(self.task) or ("--task", self.task)
        level = [] if self.level == "nominal" else ["--level", self.level]
        without = [word for names in self.without or () for word in ("--without", names)]
        return [
            *task,
            *level,
            *without,
            *(word for setting in self.settings or () for word in ("--set", setting)),
            *(word for scale in self.scale or () for word in ("--scale", scale)),
        ]


@Parameter(name="*", group=WORLD)
@dataclass(frozen=True, slots=True, kw_only=True)
class OwnErrorOptions(ErrorOptions):
    """The error options for commands with a fixed task."""

    task: Annotated[str | None, Parameter(parse=False)] = None


@Parameter(name="*", group=WORLD)
@dataclass(frozen=True, slots=True, kw_only=True)
class WorldOptions:
    """A world, or the first of several worlds."""

    seed: Annotated[
        int | None,
        Parameter(
            converter=whole,
            help="Seed of the world, a whole number from 0 to 2^53 - 1: the seed determines where the parts lie, "
            "and the size of every error. Default: 0.",
        ),
    ] = None
    errors: Annotated[ErrorOptions, Parameter(name="*")] = ErrorOptions()
    file: Annotated[
        Path | None,
        Parameter(
            name="--world",
            help="Take the world from this file, such as a file that `handeye trials rare` wrote, instead of from a "
            "seed.",
        ),
    ] = None

    @property
    def task(self) -> str | None:
        """The task given as an option, or else the task in the file of the world; None if neither was given."""
        if self.errors.task is None and self.file is not None:
            return read_world(self.file).task
        return self.errors.task

    @property
    def work(self) -> "AnyTask":
        """The task; raises InvalidInput if there is none."""
        return replace(self.errors, task=self.task).work

    @property
    def chosen(self) -> bool:
        """True if a world was chosen, not only a task."""
        return replace(self, errors=replace(self.errors, task=None)) != ANY_WORLD

    def of(self, name: str) -> Self:
        """A copy of these options for the task called `name`."""
        return replace(self, errors=self.errors.of(name))

    @property
    def spec(self) -> WorldSpec:
        """The world; raises InvalidInput if a seed, name, unit or value is invalid."""
        return self.errors.spec(self.seed or 0) if self.file is None else self._spec_of(self.file)

    def noisy(self, seed: int) -> WorldSpec:
        """The world with the noise of another seed; raises InvalidInput if the world or the seed is invalid."""
        return msgspec.structs.replace(self.spec, seed=checked_seed(seed))

    def check(self) -> None:
        """Check the options, except --without, before the program is planned. Raises InvalidInput if an option is
        wrong.
        """
        if self.file is None:
            self.errors.check(self.seed or 0)
        else:
            replace(self, errors=replace(self.errors, without=None))._spec_of(self.file)

    def _spec_of(self, path: Path) -> WorldSpec:
        """The world in a file; raises InvalidInput if this world does not fit the task, or if other options choose a
        world.
        """
        given, errors = read_world(path), self.errors
        if self.seed is not None or replace(errors, task=None) != ErrorOptions():
            raise BadArgument(
                f"--world {path} gives the whole world; leave out --seed, --level, --set and --scale, and do not "
                "name errors in --without"
            )
        work = self.work
        if given.task != work.name:
            raise BadArgument(
                f"the world in {path} belongs to the task {quoted(given.task)}, not to {quoted(work.name)}"
            )
        try:
            work.variation().check(given.world)
        except InvalidInput as error:
            raise BadFile(f"{path}: {error}") from None
        return given.world

    def apart(self, calls: Set[str]) -> "tuple[WorldOptions, tuple[str, ...]]":
        """Split the names in `--without`. The first value is a copy of these options. In this copy, `--without` names
        only errors of the world. The second value contains the senses and macros that the program must do without.
        """
        errors, spared = self.errors.apart(calls)
        return replace(self, errors=errors), spared

    def words(self) -> list[str]:
        """The options as they are typed."""
        if self.file is not None:
            return [*self.errors.words(), "--world", str(self.file)]
        return ["--seed", str(self.seed or 0), *self.errors.words()]


def broken(
    world: WorldSpec, options: list[str] | None, work: "AnyTask", listing: "Listing | None" = None
) -> WorldSpec:
    """Add to a world the faults that `options` names. Raises InvalidInput if a named fault, value or stage does not
    exist.

    Args:
        listing: the program's stages, at which faults may begin. If this is None, faults cannot begin at stages.
    """
    if not options:
        return world
    stage = from_start_only if listing is None else stage_of(listing)
    found = faults(work.faults(world), options, stage)
    return msgspec.structs.replace(world, faults=found)


def stage_of(listing: "Listing") -> StageNumber:
    """A function that converts the name of a stage, as written, to the stage's number."""
    from handeye.debugger.breakpoints import stage_number

    return lambda text: stage_number(text, listing) + 1


ANY_WORLD: Final = WorldOptions()
ANY_ERRORS: Final = ErrorOptions()
ANY_OWN_ERRORS: Final = OwnErrorOptions()
