"""The tasks of the agents' bench: each is a folder with a brief, the files that the agent is given, worlds, a
reference solution and a trivial solution.
"""

import re
import tomllib
from collections.abc import Mapping, Sequence
from functools import cached_property
from pathlib import Path
from typing import Annotated, Any, Final, Literal

import msgspec

from handeye.agents.agent_folder import AgentFolder
from handeye.agents.bench_brief import end_of_brief
from handeye.agents.bench_files import GIVEN, REFERENCE, TRIVIAL, Derived, TaskFiles
from handeye.agents.bench_right import Right
from handeye.agents.hidden_seeds import commitment
from handeye.agents.judging import setup_of
from handeye.agents.scripts import Scripts
from handeye.api.diagnostic import Diagnostic
from handeye.core.diagnostics import has_errors, quoted, suggestion
from handeye.core.entries import entry_of_file, loaded
from handeye.core.errors import BadFile, NoSuchName
from handeye.core.resources import benches
from handeye.core.source import read_source
from handeye.core.variation import Level, Seed, WorldSpec
from handeye.core.world_options import faults, from_start_only, overrides
from handeye.program.language import own_language
from handeye.runs.setup import Setup
from handeye.tasks import any_task

PROTOCOL: Final = 3  # version of docs/agents_bench.md; results of different versions cannot be compared
BUILT_IN: Final = (REFERENCE, TRIVIAL)  # solutions that each task has
PASSED: Final = 0.9  # least score with which a task is passed
BRIEF: Final = "brief.md"
_SHARED: Final = re.compile(r"^\{(\w+)\}", re.MULTILINE)  # at the beginning of a line of a brief
SOLUTION: Final = "solution"  # name of an entrant's program, without its ending
Tier = Literal["macros", "language", "bare", "repair"]


class Worlds(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The differences between a task's worlds and usual worlds. The fields are the options of `handeye.World`."""

    level: Level = "nominal"
    without: list[str] = []
    set: dict[str, float | str] = {}
    scale: dict[str, float] = {}
    faults: list[str] = []


class Case(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The properties of a world, and the behaviour of a correct program in this world."""

    worlds: Worlds = Worlds()
    right: Right = Right()
    replace: dict[
        str, str
    ] = {}  # for lines of the solution, the lines that the organiser puts in their places
    job: str = ""  # variant of the job, such as a number of pieces


class _File(Case, frozen=True, forbid_unknown_fields=True, kw_only=True):
    """The file `task.toml`."""

    title: str
    language: str  # ending of the program's file
    tier: Tier
    about: str  # what to do, as a phrase for the table of tasks
    task: str  # name of the task whose cell and referee are used
    manual: list[str] = []  # pages that the brief names
    stopping: str = ""  # how a program stops, as a phrase for the brief; empty: as usual in its language
    public: Annotated[list[Seed], msgspec.Meta(min_length=1)]
    hidden: str = ""  # SHA-256 of the hidden seeds
    kept: str = ""  # regular expression for lines that a solution must keep, in their order
    orders: bool = False  # the program is judged in every order of its tasks, and not in worlds
    variants: list[dict[str, dict[str, Any] | str]] = []
    """Variants of the case. Each variant holds the fields that it changes. The world with seed n has variant n modulo
    the number of variants.
    """
    derived: dict[str, Derived] = {}


class BenchTask(msgspec.Struct, frozen=True, kw_only=True, dict=True):
    """A task of the bench."""

    name: str
    folder: Path
    file: _File

    @property
    def files(self) -> TaskFiles:
        return TaskFiles(
            self.folder, self.file.derived, lambda name: read_task(self.folder.parent / name).files
        )

    @property
    def brief(self) -> str:
        """The page that the entrant reads."""
        own = read_source(self.folder / BRIEF).text.rstrip()
        return f"{_SHARED.sub(self._shared, own)}\n\n{end_of_brief(self, own)}"

    def _shared(self, found: re.Match[str]) -> str:
        """Return the text that a line of this brief names. Several briefs share this text."""
        return read_source(self.folder.parent / f"{found[1]}.md").text.rstrip()

    @property
    def program(self) -> str:
        """Name of the file that the entrant leaves."""
        return f"{SOLUTION}.{self.file.language}"

    def given(self) -> dict[str, bytes]:
        """Return the name and the contents of each file that an entrant is given at the start."""
        return {BRIEF: self.brief.encode(), **self.files.read(GIVEN)}

    def solution(self, kind: str) -> dict[str, bytes]:
        """Return the files of the reference solution or of the trivial one. If the task has no trivial solution of its
        own, the given program is the trivial solution.
        """
        return self.files.read(kind) or self.files.read(GIVEN)

    @cached_property
    def cases(self) -> tuple[Case, ...]:
        """The cases of the task: one for each variant of the task, or a single case if the task has no variants."""
        usual: dict[str, Any] = {
            name: msgspec.to_builtins(getattr(self.file, name)) for name in Case.__struct_fields__
        }
        found = []
        for change in self.file.variants or [{}]:
            made = dict(usual)
            for name, value in change.items():
                made[name] = usual[name] | value if isinstance(value, dict) else value
            found.append(msgspec.convert(made, Case))
        return tuple(found)

    def case(self, seed: int) -> Case:
        """Return the case to which the world with the seed `seed` belongs."""
        return self.cases[seed % len(self.cases)]

    def world(self, seed: int) -> WorldSpec:
        """Return the world with the seed `seed`."""
        worlds, task = self.case(seed).worlds, any_task(self.file.task)
        settings = [f"{name}={value}" for name, value in worlds.set.items()]
        scales = [f"{name}={factor}" for name, factor in worlds.scale.items()]
        spec = WorldSpec(
            seed=seed,
            level=worlds.level,
            overrides=overrides(task.variation(), worlds.without, settings, scales),
        )
        planted = faults(task.faults(spec), worlds.faults, from_start_only)
        return msgspec.structs.replace(spec, faults=planted)

    def setups(self, folder: Path, seeds: Sequence[int]) -> list[Setup]:
        """Return one setup for each seed. In runs with these setups, the solution in `folder` is judged. Raises
        InvalidInput if there is no solution, or if it has errors.
        """
        own = AgentFolder(folder.resolve())
        text = self._checked(own)
        entry, _ = entry_of_file(self.program)
        if entry is None:
            plan = Scripts(folder=own).plan(self.program, None, self.file.task)
            return [setup_of(plan, self.world(seed)) for seed in seeds]
        found = []
        for seed in seeds:
            case = self.case(seed)
            made = loaded(entry.programs)(
                self.file.task, self.program, _replaced(text, case.replace), case.job
            )
            world = self.world(seed)
            found.append(Setup(system=entry.name, plan=made, world=world, camera="ray", judged=True))
        return found

    def problems(self, folder: Path) -> list[tuple[bool, str]]:
        """Try the solution in `folder` in every order of the solution's concurrent tasks. Returns the problems found,
        the worst first. Each problem is a pair: a flag, which is True if the program does not notice the problem, and
        a sentence that describes the problem. Raises InvalidInput if there is no solution, or if it has errors.
        """
        text = self._checked(AgentFolder(folder.resolve()))
        entry, _ = entry_of_file(self.program)
        if entry is None or not entry.orders:
            raise BadFile(f"programs in .{self.file.language} cannot be judged in every order of their tasks")
        found: list[tuple[bool, str]] = loaded(entry.orders)(self.program, text)
        return found

    def _checked(self, own: AgentFolder) -> str:
        """Return the text of a solution. Raises InvalidInput if there is no solution, if the solution lacks lines that
        it must keep, or if the solution has errors.
        """
        if not own.has(self.program):
            raise BadFile(f"there is no file {self.program}")
        source, language = own.source(self.program), own_language(self.program)
        self._check_kept(source.text)
        found = [] if language is None else language.check(source)
        if has_errors(found):
            first = Diagnostic.of(next(each for each in found if each.severity == "error"), source)
            raise BadFile(f"{first.file}, line {first.line}: {first.message}")
        return source.text

    def _check_kept(self, text: str) -> None:
        """Raise BadFile if a solution lacks lines that it must keep, or has more such lines than the given program."""
        if not self.file.kept:
            return
        kept = re.compile(self.file.kept, re.MULTILINE)
        if kept.findall(text) != kept.findall(self.files.text(f"{GIVEN}/{self.program}")):
            raise BadFile(f"{self.program} lacks lines that the brief says to keep, or has more of them")

    def check_hidden(self, salt: str, seeds: Sequence[int]) -> None:
        """Raise BadFile unless these hidden seeds match the SHA-256 in the repository."""
        if commitment(salt, self.name, seeds) != self.file.hidden:
            raise BadFile(
                f"the hidden seeds of the task {self.name} do not match the SHA-256 in its task.toml"
            )


def _replaced(text: str, lines: Mapping[str, str]) -> str:
    """Return the program with the keys of `lines` replaced by their values. Keys and values are whole lines.

    A solution must keep the lines that are keys.
    """
    return "\n".join(lines.get(line, line) for line in text.splitlines()) + "\n"


def bench_tasks() -> dict[str, BenchTask]:
    """Return the name and the description of each task of the bench, sorted by name."""
    folders = sorted(file.parent for file in (benches() / "agents").glob("*/task.toml"))
    return {folder.name: read_task(folder) for folder in folders}


def bench_task(name: str) -> BenchTask:
    """Return the task called `name`. Raises NoSuchName if the bench has no task with this name."""
    known = bench_tasks()
    if name not in known:
        near = suggestion(name, known) or f"the tasks are {', '.join(known)}"
        raise NoSuchName(f"the bench has no task {quoted(name)}; {near}")
    return known[name]


def read_task(folder: Path) -> BenchTask:
    """Read the task in a folder. Raises BadFile if the task cannot be used."""
    try:
        file = msgspec.convert(tomllib.loads(read_source(folder / "task.toml").text), _File)
    except (tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
        raise BadFile(f"{folder / 'task.toml'} cannot be used: {error}") from None
    return BenchTask(name=folder.name, folder=folder, file=file)
