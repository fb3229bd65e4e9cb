"""Worlds for Python programs: work cells with particular errors, generated from seeds."""

import os
from collections.abc import Iterable, Mapping
from functools import cached_property
from types import MappingProxyType
from typing import TYPE_CHECKING

from msgspec.structs import replace

from handeye import tasks
from handeye.api.exporting import exported
from handeye.core import world_options
from handeye.core.arguments import given_names
from handeye.core.brief import Named, Several
from handeye.core.errors import BadArgument, NoSuchName
from handeye.core.notebook import heading, page, table
from handeye.core.variation import SPREADS, Level, WorldSpec, checked_seed
from handeye.core.world_options import by_number, overrides
from handeye.results.world_page import QuantityReport, report
from handeye.runs.exported_state import initial_state

if TYPE_CHECKING:
    from handeye.results.export import Export


class World:
    """A work cell with its particular errors: the positions of all parts and the errors of all devices, generated
    from a seed. Two worlds are equal if all their values are exactly equal.

    `values` and `quantities` give the quantities of the world, with the names and units that `handeye world` lists.

    >>> world = handeye.World(seed=3, level="high", without=["arm.offset"], set={"arm.friction": 0})
    >>> world
    World(seed=3, level='high', without=['arm.offset'], set={'arm.friction': 0})
    >>> world["arm.offset.3"], world.unit("arm.offset.3")
    (0.0, 'in')
    """

    def __init__(
        self,
        seed: int = 0,
        *,
        level: Level = "nominal",
        without: Iterable[str] = (),
        set: Mapping[str, float | str] | None = None,
        scale: Mapping[str, float] | None = None,
        faults: Iterable[str] = (),
        task: str = tasks.DEFAULT,
    ) -> None:
        """Generate a world.

        Args:
            seed: seed of the world, a whole number from 0 to 2^53 - 1.
            level: size of the errors: `low` is half of `nominal`, `high` is twice `nominal`.
            without: quantities and groups (`arm`, `arm.offset`, `arm.offset.3`) to leave at their nominal values.
            set: values of quantities or of groups. A value is a number in the unit of the quantity, or a text with a
                unit, such as `".3 in"`. A value for a group applies to every quantity in the group, in the unit of
                that quantity: a number for `arm.friction` is in N m for revolute joints and in N for the prismatic
                joint.
            scale: a factor for each name of a quantity or group. The errors of the quantity or group are multiplied by
                this factor, in addition to the level. `unsourced` stands for all errors for which no source gives a
                size.
            faults: faults to inject, from the list that `handeye faults --list` prints: `NAME` or `NAME=VALUE`.
                With `@N` at the end, the fault begins at stage N of the program.
            task: name of the task.

        Raises:
            InvalidInput: a name or unit is unknown, or a seed, level or value is not allowed; for an unknown name,
                the message suggests the nearest one.
        """
        number = checked_seed(seed)
        if not isinstance(level, str) or level not in SPREADS:
            raise NoSuchName(f"there is no level {level!r}; the levels are {', '.join(SPREADS)}")
        if not isinstance(set, Mapping | None):
            raise BadArgument(f"`set` must be a dictionary from names of quantities to values, not {set!r}")
        if not isinstance(scale, Mapping | None):
            raise BadArgument(
                f"`scale` must be a dictionary from names of quantities to factors, not {scale!r}"
            )
        self._without, self._set = given_names(without, "`without`"), dict(set or {})
        self._scale = dict(scale or {})
        self._faults = given_names(faults, "`faults`")
        self._table, self._task = tasks.any_task(task).variation(), task
        settings = [f"{name}={value}" for name, value in self._set.items()]
        scales = [f"{name}={factor}" for name, factor in self._scale.items()]
        wanted = overrides(self._table, self._without, settings, scales)
        spec = WorldSpec(seed=number, level=level, overrides=wanted)
        self._table.check(spec)
        broken = world_options.faults(tasks.any_task(task).faults(spec), self._faults, by_number)
        self._spec = replace(spec, faults=broken)

    @property
    def spec(self) -> WorldSpec:
        """The world in SI units, in the form that runs record."""
        return self._spec

    @property
    def task(self) -> str:
        """Name of the task for which the cell is built."""
        return self._task

    @property
    def seed(self) -> int:
        """Seed from which the world was generated."""
        return self.spec.seed

    @cached_property
    def values(self) -> Mapping[str, float]:
        """The value of each quantity, in the unit of the quantity. The keys are the names of the quantities."""
        drawn, table = self._table.draw(self.spec), self._table.quantities
        return MappingProxyType(
            Named((name, value / table[name].measure.size) for name, value in drawn.values.items())
        )

    @cached_property
    def quantities(self) -> tuple[QuantityReport, ...]:
        """All quantities, each with `name`, `value`, `unit` and `source`. The source says what the quantity is and
        where its size comes from.
        """
        return Several(report(self._table, self._table.draw(self.spec)).quantities)

    def __getitem__(self, name: str) -> float:
        """The value of the quantity `name`, in its unit.

        Raises:
            InvalidInput: no quantity has this name; the message suggests the nearest name.
        """
        return self.values[self._quantity(name)]

    def unit(self, name: str) -> str:
        """Return the unit of the quantity `name`; empty if the quantity is a plain number.

        Raises:
            InvalidInput: no quantity has this name; the message suggests the nearest name.
        """
        return self._table.quantities[self._quantity(name)].unit

    def export(
        self, path: str | os.PathLike[str], *, part: str | None = None, overwrite: bool = False
    ) -> "Export":
        """Export the cell of this world, in its initial state, to other programs.

        Args:
            path: a folder, to export a scene that plain MuJoCo can load; or a file name that ends in `.glb`, to
                export the solids as a 3D model.
            part: which solids to export: `cell` (the default) or `pump`.
            overwrite: replace an existing export.

        Returns:
            a record of the written files, with remarks.

        Raises:
            InvalidInput: the export cannot be written at `path`, or `part` is neither `cell` nor `pump`.
        """
        return exported(path, lambda: initial_state(self.spec, self._task), part, overwrite=overwrite)

    def _repr_html_(self) -> str:
        rows = [(each.name, f"{each.value:.4g}", each.unit, each.override or "") for each in self.quantities]
        return page(heading(repr(self)), table(("quantity", "value", "unit", ""), rows))

    def _quantity(self, name: str) -> str:
        """Check that a quantity is called `name`, and return this name. Raises InvalidInput if no quantity has this
        name.
        """
        if not isinstance(name, str):
            raise BadArgument(f"give a quantity by its name, not by {name!r}")
        found = self._table.select(name, self.spec.overrides.set)
        if name not in self._table.quantities:
            group = [quantity.name for quantity in found]
            raise BadArgument(f"`{name}` is a group of quantities: {', '.join(group)}")
        return name

    def __eq__(self, other: object) -> bool:
        return isinstance(other, World) and (self.spec, self._task) == (other.spec, other._task)

    def __hash__(self) -> int:
        return hash((self.seed, self.spec.level))

    def __repr__(self) -> str:
        said = [f"seed={self.seed}"]
        said += [f"level={self.spec.level!r}"] if self.spec.level != "nominal" else []
        said += [f"without={list(self._without)}"] if self._without else []
        said += [f"set={self._set}"] if self._set else []
        said += [f"scale={self._scale}"] if self._scale else []
        said += [f"faults={list(self._faults)}"] if self._faults else []
        said += [f"task={self._task!r}"] if self._task != tasks.DEFAULT else []
        return f"World({', '.join(said)})"
