"""The tasks of the agents' bench: each is a folder with a brief, files to begin with, worlds, a reference solution and
a trivial one.
"""

import hashlib
import re
import tomllib
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Annotated, Final, Literal

import msgspec

from handeye.agents.agent_folder import AgentFolder
from handeye.agents.judging import setup_of
from handeye.agents.scripts import Scripts
from handeye.core.diagnostics import has_errors, quoted, suggestion
from handeye.core.entries import entry_of_file, loaded
from handeye.core.errors import BadFile, NoSuchName
from handeye.core.files import read_whole
from handeye.core.resources import benches
from handeye.core.source import read_source
from handeye.core.variation import Level, Seed, WorldSpec
from handeye.core.world_options import overrides
from handeye.program.language import own_language
from handeye.runs.setup import Setup
from handeye.tasks import any_task

PROTOCOL: Final = 1  # version of docs/agents_bench.md; results of different versions cannot be compared
GIVEN, REFERENCE, TRIVIAL = "given", "reference", "trivial"  # folders of a task
BRIEF: Final = "brief.md"
SOLUTION: Final = "solution"  # name of an entrant's program, without its ending
_LARGEST: Final = 1 << 20  # bytes of a file of hidden seeds
Tier = Literal["macros", "language", "bare", "repair"]


class Worlds(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """How the worlds of a task differ from usual ones; as the options of `handeye.World`."""

    level: Level = "nominal"
    without: list[str] = []
    set: dict[str, float | str] = {}
    scale: dict[str, float] = {}


class _File(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The file `task.toml`."""

    title: str
    language: str  # ending of the program's file
    tier: Tier
    task: str  # name of the task whose cell and referee are used
    public: Annotated[list[Seed], msgspec.Meta(min_length=1)]
    hidden: str = ""  # SHA-256 of the hidden seeds
    kept: str = ""  # regular expression for lines that a solution must keep, in their order
    worlds: Worlds = Worlds()


class BenchTask(msgspec.Struct, frozen=True, kw_only=True):
    """A task of the bench."""

    name: str
    folder: Path
    file: _File

    @property
    def brief(self) -> str:
        """The page that the entrant reads."""
        return read_source(self.folder / BRIEF).text

    @property
    def program(self) -> str:
        """Name of the file that the entrant leaves."""
        return f"{SOLUTION}.{self.file.language}"

    def given(self) -> dict[str, bytes]:
        """Return the files with which an entrant begins, by name."""
        return {BRIEF: self.brief.encode(), **_files(self.folder / GIVEN)}

    def solution(self, kind: str) -> dict[str, bytes]:
        """Return the files of the reference solution or of the trivial one."""
        return _files(self.folder / kind)

    def world(self, seed: int) -> WorldSpec:
        """Return the world with this seed."""
        worlds = self.file.worlds
        settings = [f"{name}={value}" for name, value in worlds.set.items()]
        scales = [f"{name}={factor}" for name, factor in worlds.scale.items()]
        wanted = overrides(any_task(self.file.task).variation(), worlds.without, settings, scales)
        return WorldSpec(seed=seed, level=worlds.level, overrides=wanted)

    def setups(self, folder: Path, seeds: Sequence[int]) -> list[Setup]:
        """Return the runs that judge the solution in a folder, one for each seed. Raises InvalidInput if there is no
        solution, or if it has errors.
        """
        own = AgentFolder(folder.resolve())
        if not own.has(self.program):
            raise BadFile(f"there is no file {self.program}")
        self._check_kept(own.source(self.program).text)
        entry, _ = entry_of_file(self.program)
        if entry is None:
            plan = Scripts(folder=own).plan(self.program, None, self.file.task)
            return [setup_of(plan, self.world(seed)) for seed in seeds]
        source, language = own.source(self.program), own_language(self.program)
        found = [] if language is None else language.check(source)
        if has_errors(found):
            raise BadFile(
                f"{self.program}: {next(each.message for each in found if each.severity == 'error')}"
            )
        made = loaded(entry.programs)(self.file.task, self.program, source.text)
        return [
            Setup(system=entry.name, plan=made, world=self.world(seed), camera="ray", judged=True)
            for seed in seeds
        ]

    def _check_kept(self, text: str) -> None:
        """Raise BadFile if a solution lacks lines that it must keep, or has more of them."""
        if not self.file.kept:
            return
        kept = re.compile(self.file.kept, re.MULTILINE)
        wanted = kept.findall(read_source(self.folder / GIVEN / self.program).text)
        if kept.findall(text) != wanted:
            raise BadFile(
                f"the lines of {self.program} that the brief says to keep are not those of the given program"
            )

    def check_hidden(self, salt: str, seeds: Sequence[int]) -> None:
        """Raise BadFile unless these are the hidden seeds to which the repository is committed."""
        if commitment(salt, self.name, seeds) != self.file.hidden:
            raise BadFile(
                f"the hidden seeds of the task {self.name} are not those to which handeye is committed"
            )


class HiddenSeeds(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The file of hidden seeds, which is not in the repository."""

    salt: Annotated[str, msgspec.Meta(min_length=16)]
    seeds: Mapping[str, list[Seed]]  # by task


def read_hidden(path: Path) -> HiddenSeeds:
    """Read a file of hidden seeds. Raises BadFile if it cannot be used."""
    try:
        return msgspec.json.decode(read_whole(path, _LARGEST), type=HiddenSeeds)
    except (msgspec.DecodeError, UnicodeDecodeError) as error:
        raise BadFile(f"{path} is not a file of hidden seeds: {error}") from None


def commitment(salt: str, task: str, seeds: Sequence[int]) -> str:
    """Return the SHA-256 of the hidden seeds of a task. The salt keeps short lists from being guessed."""
    return hashlib.sha256(f"{salt}:{task}:{','.join(map(str, seeds))}".encode()).hexdigest()


def bench_tasks() -> dict[str, BenchTask]:
    """Return all tasks of the bench by name, sorted."""
    folders = sorted(file.parent for file in (benches() / "agents").glob("*/task.toml"))
    return {folder.name: _read(folder) for folder in folders}


def bench_task(name: str) -> BenchTask:
    """Return a task of the bench. Raises NoSuchName if there is none."""
    known = bench_tasks()
    if name not in known:
        near = suggestion(name, known) or f"the tasks are {', '.join(known)}"
        raise NoSuchName(f"the bench has no task {quoted(name)}; {near}")
    return known[name]


def _read(folder: Path) -> BenchTask:
    try:
        file = msgspec.convert(tomllib.loads(read_source(folder / "task.toml").text), _File)
    except (tomllib.TOMLDecodeError, msgspec.ValidationError) as error:
        raise BadFile(f"{folder / 'task.toml'} cannot be used: {error}") from None
    return BenchTask(name=folder.name, folder=folder, file=file)


def _files(folder: Path) -> dict[str, bytes]:
    return {file.name: read_whole(file) for file in sorted(folder.glob("*.*"))}
