"""A run controlled from Python: step, go back, and read its state."""

import os
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any, Self

import msgspec
import numpy as np
from numpy.typing import NDArray

from handeye.api.exporting import exported
from handeye.api.plans import Plan
from handeye.api.run_page import run_page
from handeye.api.state import Answer, State, answer, state_of
from handeye.api.trace import Trace
from handeye.core.arguments import given_count, given_file, given_place
from handeye.core.brief import Several
from handeye.core.errors import BadArgument, Refused
from handeye.core.files import check_place
from handeye.core.plain_text import counted
from handeye.debugger.breakpoints import breakpoint, is_ahead, stage_number
from handeye.debugger.reply import Break
from handeye.debugger.stepper import Stepper
from handeye.debugger.views import last_picture
from handeye.program.events import AnyEvent
from handeye.results.finishing import finished, outcome
from handeye.results.judging import Referee
from handeye.results.pauses import pause_sentence
from handeye.results.pictures import annotated_webp
from handeye.results.result import Result
from handeye.runs.advance import AfterSteps, AnyStop, AtStage, DriverFailure, Pause
from handeye.runs.checkpoint_file import CHECKPOINT, write_checkpoint
from handeye.runs.exported_state import present_state
from handeye.runs.folder import TRACE, RunFolder
from handeye.runs.host_seconds import Meter
from handeye.runs.operator import Operator, attend, beginnings
from handeye.runs.setup import plan_of
from handeye.runs.undo_orders import stage_began
from handeye.trace.reading import read_trace_as

if TYPE_CHECKING:
    from handeye.results.export import Export

Place = str | int
"""A stage or a part of its name, a label, an instruction, `error:N`, or a line of the script."""


@dataclass(frozen=True, slots=True, kw_only=True)
class RunEnding:
    """Settings for the end of a run."""

    folder: RunFolder | None
    judged: bool
    referee: Referee | None
    meter: Meter  # measures what the run costs this computer


class Run:
    """A run of a plan in a world, which pauses where you ask; `handeye.begin` begins one.

    Methods that move it return the `State` in which it pauses, which says why. As a context manager it closes itself.

    `CLOSE .5` needs a part at least half an inch thick: on an empty hand it calls the operator.

    >>> with handeye.begin("OPEN 1\\nL1: CLOSE .5\\nOPEN 2\\n", camera="ray") as run:
    ...     state = run.until("L1")
    ...     print(state.line, state.why)
    ...     print(run.until().why)
    2 breakpoint at label L1
    the program called the operator: ...
    """

    def __init__(self, stepper: Stepper, keeping: RunEnding, why: str) -> None:
        """Use `handeye.begin`."""
        self._stepper, self._session = stepper, stepper.session
        self._runner, self._keeping = stepper.session.runner, keeping
        self._why: str | None = why
        self._closed: Result | None = None
        self._outcome: tuple[int, Result] | None = None
        self._broken: DriverFailure | None = None

    # -- running --------------------------------------------------------------------------------------

    def step(self, n: int = 1) -> State:
        """Do the next `n` steps, or fewer if something stops the run.

        Raises:
            InvalidInput: the run cannot continue, or `n` is not a whole number of 1 or more.
        """
        return self._go(steps=given_count(n, "steps"))

    def until(self, place: Place | None = None) -> State:
        """Run to a place, or to the end; a breakpoint or a call of the operator also stops the run.

        Args:
            place: a stage, by its name or a unique part of it; a label; an instruction (`"AOJ"`: the next step
                that begins with it); a line (58, `"pins.al:3"`); or `"error:23"`: after the step that raises it.

        Raises:
            InvalidInput: the run cannot continue, there is no such place, or the run cannot reach it from here.
        """
        stops: list[AnyStop] = []
        if place is not None:
            stops.append(breakpoint(given_place(place), self._runner.listing))
            if not is_ahead(stops[0], self._runner.checkpoint()):
                raise BadArgument(f"the run cannot reach {place} from here")
        return self._go(stops)

    def back(self, steps: Place = 1) -> State:
        """Go back to before some steps: arm, parts, program and clock; the events of these steps are dropped.

        Args:
            steps: the number of steps; or a stage, by its name or a part of it: back to where it last began.

        Raises:
            InvalidInput: the run has not reached it, or its state then is no longer kept.
        """
        self._check_open()
        if isinstance(steps, str):
            stage = stage_number(steps, self._runner.listing)
            if stage not in beginnings(self._runner):
                raise Refused(f"stage {self._runner.listing.stages[stage]} has not begun yet")
            position = beginnings(self._runner)[stage]
        else:
            count = given_count(steps, "steps")
            position = self._runner.position - count
            if position < 0:
                raise _too_many(count, self._runner.position, "done")
        self._session.back_to(position)
        return self._stand("went back")

    def undo(self, steps: Place = 1) -> State:
        """Have the arm undo its work, the last step first, under guards; the program can continue from there.

        `back` resets the simulator; here the arm moves, as it would on a real machine. The undone steps stay in the
        events. If something resists, or the hand holds something else than it did then, the program calls the operator.

        Args:
            steps: the number of executed steps to undo; or a stage, by its name or a part of it: to where it last
                began.

        Raises:
            InvalidInput: fewer steps were executed, or the run cannot continue.

        >>> run = handeye.begin("OPEN 1\\nOPEN 2\\n", camera="ray")
        >>> run.until().why
        'the program finished'
        >>> run.undo().line
        2
        """
        self._check_open()
        executed = self._runner.system.executed
        if isinstance(steps, str):
            stage = stage_number(steps, self._runner.listing)
            left = stage_began(executed, self._runner.listing, stage)
        else:
            count = given_count(steps, "steps")
            left = len(executed) - count
            if left < 0:
                raise _too_many(count, len(executed), "executed")
        return self._stand(reason(self._session.have_undone(left)))

    def dismantle(self) -> State:
        """Have the arm undo all its work; the run then ends, and `result.apart` has the referee's verdict.

        Raises:
            InvalidInput: there is nothing to undo.
        """
        self._check_open()
        pause = self._session.have_undone(0, halts=True)
        self._keeping = replace(self._keeping, judged=True)
        return self._stand(reason(pause))

    def break_at(self, place: Place) -> Break:
        """Pause at a place whenever the run reaches it; places are those of `until`.

        Returns:
            the breakpoint and its `number`, with which `run.say("delete 1")` removes it.

        Raises:
            InvalidInput: there is no such place, or the run is closed.
        """
        self._check_open()
        return self._session.add_break(given_place(place))

    def say(self, line: str) -> Answer:
        """Give a command of the stepper (`handeye run --step`), such as `"show force"`, `"set saved H 0 0 .1"`,
        `"retry"`.

        Returns:
            the answer as a record; `print` shows it as the stepper does. A wrong command changes nothing, and its
            answer has the reason in `error`.

        Raises:
            InvalidInput: the line is not a text, or the run is closed.

        >>> run = handeye.begin("OPEN 1\\nOPEN 2\\n", camera="ray")
        >>> print(run.say("show gap"))
        ── stage 1, program, step 0; 0 steps done, 0.00 s
        gap       -0.002 in
        """
        self._check_open()
        if not isinstance(line, str):
            raise BadArgument(f"a command of the stepper must be a text, not {line!r}")
        reply = self._stepper.do(line)
        self._why = None if reply.pause is None else reason(reply.pause)
        if self._stepper.over:
            self.close()
        return answer(reply)

    def _go(self, stops: list[AnyStop] | None = None, steps: int | None = None) -> State:
        self._check_open()
        self._why = None
        return self._stand(reason(self._session.go(stops or [], steps)))

    def reach(self, stage: int) -> State:
        """Run until a stage, given by its index, is about to begin; a run already there stays.

        Raises:
            InvalidInput: the run never reaches it, or stopped before it; the run is then closed.
        """
        name = self._runner.listing.stages[stage]
        begins = AtStage(stage=stage, name=name)
        if begins.met_before(self._runner) or (stage == 0 and not self._runner.position):
            return self.state
        try:
            if not is_ahead(begins, self._runner.checkpoint()):
                raise BadArgument(f"the run never reaches “{name}” from where it starts")
            state = self._go([begins])
            if not begins.met_before(self._runner):
                raise Refused(f"the run stopped before “{name}”: {state.why}")
        except BaseException:
            self.close()
            raise
        return state

    def attend(self, operator: Operator) -> State:
        """Run to the end, with a person or a rule to answer calls of the operator."""
        self._check_open()
        try:
            pause = attend(self._runner, operator, [], self._session.kept)
        except BaseException:
            self._runner.rollback()
            raise
        return self._stand(reason(pause))

    def _stand(self, why: str) -> State:
        self._why = why
        return self.state

    # -- knowing --------------------------------------------------------------------------------------

    @property
    def plan(self) -> Plan:
        """The plan of the run."""
        return Plan(record=plan_of(self._runner.setup))

    @property
    def state(self) -> State:
        """The state in which the run is paused."""
        stage = self._session.stage
        name = None if stage is None else self._runner.listing.stages[stage]
        why = reason(self._session.pause) if self.ended else self._why
        return state_of(self._runner, name, why or "paused")

    @property
    def events(self) -> tuple[AnyEvent, ...]:
        """All events that were not undone, as records of `handeye.program.events`."""
        return Several(self._runner.events)

    @property
    def picture(self) -> NDArray[np.uint8] | None:
        """The last picture that the program took, shape (256, 333), 0 (black) to 15; None if it took none."""
        name = last_picture(self._runner)
        return None if name is None else self._runner.system.shots[name].picture.copy()

    @property
    def ended(self) -> bool:
        """True if no step is possible unless the operator answers, or the run goes back."""
        return self._runner.ended

    @property
    def out(self) -> Path | None:
        """The folder that keeps the run."""
        return None if self._keeping.folder is None else self._keeping.folder.path

    @property
    def trace(self) -> Trace:
        """The trace of the run, once it is closed.

        Raises:
            InvalidInput: the run has no folder, or is not closed.
        """
        if self.out is None:
            raise Refused("the run has no folder and therefore no trace; begin it with out=...")
        if self._closed is None:
            raise Refused("the trace is complete when the run is closed: leave its `with`, or close() it")
        return read_trace_as(Trace, self.out / TRACE)

    @property
    def result(self) -> Result:
        """The result of the run so far; the referee judges it only if the program has ended."""
        if self._closed is not None:
            return self._closed
        happened = len(self._runner.events)
        if self._outcome is None or self._outcome[0] != happened:
            self._outcome = happened, self._ended(outcome)
        return self._outcome[1]

    @property
    def completed(self) -> bool:
        """True if the program ended, or the arm finished undoing what it was asked to."""
        return self.result.completed

    @property
    def assembled(self) -> bool | None:
        """True if the referee finds the work right; None if it was not asked, or not yet."""
        return self.result.assembled

    # -- keeping --------------------------------------------------------------------------------------

    def checkpoint(self, path: str | os.PathLike[str] | None = None) -> Path:
        """Save the present state: `handeye.begin` and `handeye resume` continue from it.

        Args:
            path: the file to write; by default a new one in the folder of the run.

        Returns:
            the file.

        Raises:
            InvalidInput: it cannot be written, the run is closed, or it has no folder and no file is named.
        """
        self._check_open()
        kept = self._runner.checkpoint()
        if path is None:
            folder = self._keeping.folder
            if folder is None:
                raise Refused("this run has no folder for checkpoints; name a file")
            return folder.kept.save(kept)
        file = given_file(path, "the destination of a checkpoint must be a file")
        check_place(file, CHECKPOINT)
        write_checkpoint(file, kept)
        return file

    def export(
        self, path: str | os.PathLike[str], *, part: str | None = None, overwrite: bool = False
    ) -> "Export":
        """Export the present cell to other programs, whether the run is closed or not.

        Args:
            path: a folder, for a scene that plain MuJoCo can load; or a file that ends in .glb, for solids.
            part: which solids: `cell`, the default, or `pump`.
            overwrite: replace an existing export.

        Returns:
            a record of the written files, with remarks; an unfinished run is marked as such.

        Raises:
            InvalidInput: it cannot be written there, there is no such part, or the run has no cell.

        >>> run = handeye.begin("OPEN 1\\n", camera="ray")
        >>> run.export(folder).moment
        'unfinished'
        """
        return exported(path, lambda: present_state(self._runner), part, overwrite=overwrite)

    def close(self) -> None:
        """End the run, and complete its folder: trace, pictures, result, and a checkpoint if it can continue."""
        if self._closed is not None:
            return
        folder = self._keeping.folder
        try:
            if folder is not None and not self.ended:
                folder.checkpoint(self._runner.checkpoint())
            self._closed = self._ended(finished, folder=folder)
        finally:
            if folder is not None:
                folder.close()

    def _ended(self, make: Callable[..., Result], **more: Any) -> Result:
        """The result of the run as it now pauses."""
        keeping, pause = self._keeping, self._session.pause
        if self._broken is not None and pause.kind == "break":
            pause = msgspec.structs.replace(pause, met=self._broken)
        return make(
            self._runner,
            pause,
            keeping.meter,
            judged=keeping.judged,
            referee=keeping.referee,
            **more,
        )

    def _check_open(self) -> None:
        if self._closed is not None:
            raise Refused("the run is closed; begin another, or continue from one of its checkpoints")

    def __enter__(self) -> Self:
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        if kind is not None:
            self._broken = DriverFailure(exception=kind.__name__)
        self.close()

    # -- showing --------------------------------------------------------------------------------------

    def __repr__(self) -> str:
        setup = self._runner.setup
        return f"<Run {self._runner.listing.name}, {setup.world}: {self.state}>"

    def _repr_html_(self) -> str:
        name = last_picture(self._runner)
        webp = None if name is None else annotated_webp(self._runner.system, name)
        return run_page(self.result, self.state, name, webp)


def _too_many(steps: int, done: int, how: str) -> Refused:
    """The error for undoing more steps than were done or executed."""
    left = f"only {done} {'has' if done == 1 else 'have'}" if done else "none has"
    return Refused(f"{counted(steps, 'step')} cannot be undone: {left} been {how}")


def reason(pause: Pause) -> str:
    """Why a run pauses, as the second half of a sentence."""
    if isinstance(pause.met, AfterSteps):
        return f"paused after {counted(pause.met.count, 'step')}"
    said = pause_sentence(pause)
    return f"the program called the operator: {said}" if pause.kind == "operator" else said
