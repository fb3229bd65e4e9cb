"""Options that choose a world, the same on every command that builds one."""

from dataclasses import dataclass
from typing import Annotated, Final, Literal

from cyclopts import Group, Parameter

from handeye.cli.common import whole
from handeye.errors import InvalidInput
from handeye.tasks import task
from handeye.variation import WorldSpec, checked_seed
from handeye.world_options import overrides

_GROUP: Final = Group("World", sort_key=1)


@Parameter(name="*", group=_GROUP)
@dataclass(frozen=True, slots=True, kw_only=True)
class ErrorOptions:
    """Which errors a world has, and how large they are."""

    level: Annotated[
        Literal["low", "nominal", "high"],
        Parameter(help="How large errors are: `low` is half as large as nominal, `high` twice."),
    ] = "nominal"
    without: Annotated[
        list[str] | None,
        Parameter(
            help="Errors or groups of them to switch off, separated by commas; `handeye world` lists their names.",
            consume_multiple=False,
        ),
    ] = None
    settings: Annotated[
        list[str] | None,
        Parameter(
            name="--set",
            help="NAME=VALUE: a value for a quantity, or for each of a group, such as camera.place.x=.3in; may be "
            "repeated.",
            consume_multiple=False,
        ),
    ] = None

    def spec(self, seed: int) -> WorldSpec:
        """The world of a seed with these errors.

        Raises:
            InvalidInput: no such seed, name, unit or value.
        """
        checked_seed(seed)
        off = [name.strip() for names in self.without or () for name in names.split(",")]
        if "" in off:
            raise InvalidInput(
                "--without needs names of errors, with one comma between two; `handeye world` lists them"
            )
        wanted = overrides(task().variation(seed), off, self.settings or ())
        return WorldSpec(seed=seed, level=self.level, overrides=wanted)

    def words(self) -> list[str]:
        """The options as they would be typed."""
        level = [] if self.level == "nominal" else ["--level", self.level]
        without = [word for names in self.without or () for word in ("--without", names)]
        return [*level, *without, *(word for setting in self.settings or () for word in ("--set", setting))]


@Parameter(name="*", group=_GROUP)
@dataclass(frozen=True, slots=True, kw_only=True)
class WorldOptions:
    """A world, or the first of several."""

    seed: Annotated[
        int | None,
        Parameter(
            converter=whole,
            help="Number of the world: draws where things lie, and every error. By default 0.",
        ),
    ] = None
    errors: Annotated[ErrorOptions, Parameter(name="*")] = ErrorOptions()

    @property
    def spec(self) -> WorldSpec:
        """The world.

        Raises:
            InvalidInput: no such seed, name, unit or value.
        """
        return self.errors.spec(self.seed or 0)

    def words(self) -> list[str]:
        """The options as they would be typed."""
        return ["--seed", str(self.seed or 0), *self.errors.words()]


ANY_WORLD: Final = WorldOptions()
ANY_ERRORS: Final = ErrorOptions()
