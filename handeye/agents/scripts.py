"""Plans the scripts of an agent. Scripts and taught positions come only from the agent's calls and folder."""

import posixpath
from dataclasses import dataclass
from pathlib import Path, PurePath

from handeye import tasks
from handeye.agents.agent_folder import AgentFolder
from handeye.al import AL, sewn
from handeye.api.diagnostic import Diagnostic, ScriptError
from handeye.api.plans import Plan
from handeye.core.diagnostics import has_errors, quoted
from handeye.core.entries import entries, entry_of_file, refusal
from handeye.core.errors import NoSuchName
from handeye.core.resources import plans
from handeye.core.source import Source, read_source
from handeye.program.language import language_of, own_language
from handeye.program.taught import Taught, read_taught
from handeye.runs.scripts import LANGUAGES, UNNAMED, planned, program_named, program_names, taught_beside
from handeye.tasks.interface import Task


def languages() -> list[str]:
    """Return the endings of the files of all languages, such as `.al`."""
    return [*LANGUAGES, *(ending for entry in entries().values() for ending in entry.languages)]


@dataclass(frozen=True, slots=True, kw_only=True)
class Scripts:
    """The scripts that an agent can name: the scripts in the agent's own folder, and the scripts included with
    handeye.
    """

    folder: AgentFolder

    def checked(
        self, script: str, taught: str | None, task: str | None, language: str = "al"
    ) -> tuple[Source, tuple[Diagnostic, ...]]:
        """Check a script in any language. Returns the script's text and the diagnostics. Raises InvalidInput if a file
        or name cannot be used.
        """
        if f".{language}" not in languages():
            raise NoSuchName(
                f"there is no language {quoted(language)}; the languages are {', '.join(languages())}"
            )
        source = self._source(script, f"script.{language}")
        own = own_language(source.name)
        if own is not None:
            return source, tuple(Diagnostic.of(each, source) for each in own.check(source))
        source, known, work = self._parts(script, taught, task)
        made = planned(source, known, work, language_of(PurePath(source.name), LANGUAGES))
        return source, tuple(Diagnostic.of(each, source) for each in made.diagnostics)

    def plan(self, script: str, taught: str | None, task: str | None) -> Plan:
        """Plan a script. Raises ScriptError if the script has errors, or InvalidInput if a file or name cannot be
        used.
        """
        source, known, work = self._parts(script, taught, task)
        entry, _ = entry_of_file(source.name)
        if entry is not None:
            raise refusal(entry.name, "plans", source.name)
        made = planned(source, known, work, AL)
        found = tuple(Diagnostic.of(each, source) for each in made.diagnostics)
        if made.plan is None or has_errors(made.diagnostics):
            raise ScriptError(found)
        return Plan(record=made.plan, diagnostics=found)

    def _parts(self, script: str, taught: str | None, task: str | None) -> tuple[Source, Taught, Task]:
        """Read a script, the texts that the script requires, its taught positions and its task."""
        program = None if "\n" in script or self._has(script) else program_named(script)
        work = tasks.task(task) if task is not None else program[1] if program else tasks.task()
        if program is not None:
            known = taught_beside(program[0]) if taught is None else self._taught(taught)
            return _included(program[0]), known, work
        source = self._source(script, UNNAMED)
        beside = None if source.name == UNNAMED else source.name.rsplit(".", 1)[0] + ".toml"
        if taught is not None:
            known = self._taught(taught)
        else:
            known = self._taught(beside) if beside is not None and self.folder.has(beside) else Taught()
        below = posixpath.dirname(source.name)
        return sewn(source, lambda key: self.folder.source(posixpath.join(below, key)).text), known, work

    def _source(self, script: str, name: str) -> Source:
        """Read the text of a script, without the texts that it requires. If `script` is the text itself instead of a
        file, the script gets the name `name`.
        """
        if "\n" in script:
            return Source(name=name, text=script.removeprefix("\ufeff"))
        if not self._has(script) and (program := program_named(script)) is not None:
            return _included(program[0])
        if not self._has(script):
            raise NoSuchName(
                f"there is no script {quoted(script)}, neither in the folder nor among the included programs "
                f"({', '.join(program_names())}); a script given as text must contain a line break"
            )
        return self.folder.source(script)

    def _taught(self, given: str) -> Taught:
        if "\n" in given:
            return read_taught(Source(name="taught.toml", text=given))
        if not self.folder.has(given) and (program := program_named(given)) is not None:
            return taught_beside(program[0])
        return read_taught(self.folder.source(given))

    def _has(self, script: str) -> bool:
        return self.folder.has(script)


def _included(file: Path) -> Source:
    """Read a script that is included with handeye. The script's name is the name of the file, without its folder."""
    text = Source(name=file.name, text=read_source(file).text)
    return sewn(text, lambda key: read_source(file.parent / key).text)


def included(name: str) -> str | None:
    """Return the text of a script or taught file that is included with handeye; None if there is no such file."""
    names = {file.name for file in plans().iterdir() if file.suffix in (*languages(), ".toml")}
    return (plans() / name).read_text(encoding="utf-8") if name in names else None
