"""The runs of an agent. They are begun, reopened and forked in the agent's folder, and closed when the agent leaves."""

import warnings
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path
from typing import Final

import handeye.api.begin as api
from handeye.agents.agent_folder import AgentFolder
from handeye.agents.call import Call
from handeye.api.plans import Plan
from handeye.api.run import Run
from handeye.api.worlds import World
from handeye.core.errors import NoSuchName, Refused, Taken
from handeye.core.source import line_name
from handeye.results.kept_run import kept_run
from handeye.results.result import Result

MOST_OPEN: Final = 4  # cells in memory at a time; an older run is closed, and opened again when it is used


@dataclass(eq=False, slots=True)
class OpenRuns:
    """The runs in the folder of an agent. The runs in use are open: their cells are in memory."""

    folder: AgentFolder
    _open: dict[str, Run] = field(default_factory=dict)  # in the order of their last use
    _last: str | None = None
    _call: Call = field(default_factory=Call)

    def begin(self, name: str | None, plan: Plan, world: World, call: Call) -> tuple[str, Run]:
        """Begin a run, paused before its first step. Raises InvalidInput if the name is taken or cannot be used."""
        return self._added(name, call, lambda out: self._begun(plan, out, world=world))

    def fork(self, run: str | None, stage: str, to: str | None, call: Call) -> tuple[str, Run]:
        """Begin a run with the state that another run has now, or with the state that it had before a stage. Raises
        InvalidInput if the other run, its state or the stage does not exist, or if the new run's name is taken.
        """
        source = self.named(run)
        present = self._open.get(source)
        start = self.folder.run(source) if present is None or stage else present.checkpoint()
        return self._added(to, call, lambda out: self._begun(start, out, at=stage or None))

    def find(self, run: str | None, call: Call) -> tuple[str, Run]:
        """Return the run called `run` or, if `run` is None, the run that was used last. A closed run is opened again.
        Raises InvalidInput if the folder has no run with this name, or if the run ended before it was closed.
        """
        name = self.named(run)
        if name not in self._open:
            path = self.folder.run(name)
            if kept_run(path).result.completed:
                raise Refused(
                    f"the run {name} ended earlier and is closed: `result` shows its result, and `fork` continues from "
                    "one of its states"
                )
            self._keep(name, self._using(call, lambda: self._begun(path, path)))
        self._keep(name, self._open[name])
        self._call = call
        call.told = partial(_where, self._open[name])
        return name, self._open[name]

    def result(self, run: str | None) -> tuple[str, Result]:
        """Return the result of a run, open or closed. Raises InvalidInput if the folder does not have this run."""
        name = self.named(run)
        present = self._open.get(name)
        self._last = name
        return name, kept_run(self.folder.run(name)).result if present is None else present.result

    def close(self) -> None:
        """Close all runs. Runs that have not ended can be resumed."""
        while self._open:
            self._open.pop(next(iter(self._open))).close()

    def named(self, run: str | None) -> str:
        """Return the name of a run in the folder: the run called `run`, or the run that was used last if `run` is
        None. Raises NoSuchName if the folder does not have this run.
        """
        name = run or self._last
        known = self.folder.runs()
        if name is None:
            raise NoSuchName(
                f"name a run: {', '.join(known)}" if known else "no run has begun yet; `run` begins one"
            )
        if not self.folder.run(name).is_dir():
            raise NoSuchName(f"there is no run {name}; the runs are {', '.join(known) or 'none'}")
        return name

    def _added(self, name: str | None, call: Call, make: Callable[[Path], Run]) -> tuple[str, Run]:
        chosen = name or self.folder.free_run()
        path = self.folder.run(chosen)
        if path.exists():
            raise Taken(f"there is already a run {chosen}; choose another name")
        run = self._using(call, lambda: make(path))
        self._keep(chosen, run)
        call.told = partial(_where, run)
        return chosen, run

    def _using(self, call: Call, make: Callable[[], Run]) -> Run:
        self._call = call
        return make()

    def _begun(
        self, script: Plan | Path, out: Path, *, world: World | None = None, at: str | None = None
    ) -> Run:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # the result of the run repeats them
            return api.begin(
                script, world=world, at=at, out=out, judge=True, halt=lambda: self._call.halted()
            )

    def _keep(self, name: str, run: Run) -> None:
        self._open.pop(name, None)
        self._open[name], self._last = run, name
        while len(self._open) > MOST_OPEN:
            self._open.pop(next(iter(self._open))).close()


def _where(run: Run) -> str:
    """Say where a run is."""
    state = run.state
    line = "" if state.line is None else f", line {line_name(state.line, state.file)}: {state.text}"
    return f"{state.time:.1f} s, {state.stage or 'after the last stage'}{line}"
